"""The paper's own method, to compare with: sweeps of relaxed line or point solutions.

A sweep marks contact by the gap, solves each x-line for new pressures [Liu eqs. 37, 41, 52], moves a small
part of the way [Liu eq. 53, whose sign is mended]; every few sweeps H0 follows the load [Liu eq. 54].
"""

from dataclasses import dataclass, field
from functools import partial
from itertools import count

import numpy as np
from scipy.linalg import solve_banded

from mgehl.config_sections import RelaxationSection, SolverSection
from mgehl.discretization.axes import own
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.residual import residual as residual_of
from mgehl.discretization.rows import PRESSURE, rows_of
from mgehl.discretization.status import (
    BOUNDARY,
    CAVITATED,
    CONTACT,
    LUBRICATED,
    enclosed,
    is_solid,
    open_faces,
)
from mgehl.solver.journal import NOTHING_KEPT
from mgehl.solver.outcome import Line, Outcome
from mgehl.solver.problem import DIVERGED, State
from mgehl.solver.record import Kept

REPORT_EVERY = 100
"""Sweeps from one row of the history to the next."""


@dataclass(frozen=True)
class RelaxationSettings(RelaxationSection):
    """The keys of the section, and what ends it. Updates by lines are [Liu eqs. 37, 41], by points [Liu
    eqs. 36, 42]; `stability` is C_c of [Liu eqs. 40-42], `load_factor` omega_w of [Liu eq. 54]."""

    tolerance: float = SolverSection.tolerance


@dataclass
class Sweep(Line):
    """The state before a sweep and how far that wants to move it."""

    e_p: float
    """[Liu eq. 45], of all nodes; then of the fluid and of the solid alone."""
    e_p_fluid: float
    e_p_solid: float


@dataclass
class Standing(Kept):
    """Where the relaxation stands before a sweep."""

    PARTS = {"state": State}
    ROWS = {"cycles": ("history", Sweep)}

    state: State
    cycles: list = field(default_factory=list)
    """The history, a `Sweep` every so many."""
    next_sweep: int = 0
    """Its number."""


def relax(problem, state, settings, monitor, journal=NOTHING_KEPT):
    """Relax `state` in place until its true residual and load hold; return the `Outcome`. One convolution a
    sweep. `monitor` is called with a `Sweep` every `REPORT_EVERY`; the `journal` as in `Newton.run`."""
    grid = problem.grid
    outcome = journal.recall(grid, partial(Outcome.from_record, line=Sweep))
    if outcome is None:
        standing = journal.standing(grid, Standing.from_record) or Standing(state)
        converged, reason = _relax(problem, standing, settings, monitor, journal)
        outcome = Outcome(standing.state, converged, reason, standing.cycles)
        journal.finish(grid, outcome)
    return outcome


def _relax(problem, standing, settings, monitor, journal):
    """The sweeps from `standing` on; whether they converged, and why they ended."""
    relaxation, state = _Relaxation(problem, settings), standing.state
    for step in count(standing.next_sweep):
        standing.next_sweep = step
        journal.step(problem.grid, standing)
        relaxation.mark_contact(state)
        state.p[:] = state.P
        evaluation = problem.evaluate(state).filled(None)
        relaxation.mark_cavities(state, evaluation)
        change = relaxation.change(state, evaluation)
        if step == settings.max_sweeps or step % REPORT_EVERY == 0:
            sweep = relaxation.sweep(step, state, evaluation, change)
            standing.cycles.append(sweep)
            monitor(sweep)
            end = _end(sweep, settings)
            if end:
                _settle_contents(problem, state)
                return end
        relaxation.move(state, change, step)


def _settle_contents(problem, state):
    """Give cavities what flows into them, in place: their pressure is nothing, whatever they hold."""
    state.p, state.filling = state.P.copy(), np.ones(state.P.shape)
    problem.march_contents(state, problem.evaluate(state))


def _end(sweep, settings):
    """(Converged, reason) where the relaxation ends before this sweep, else None."""
    if not sweep.residual < DIVERGED:
        return False, f"diverged: residual {sweep.residual:.1e} after {sweep.step} sweeps"
    if max(sweep.residual, abs(sweep.load_error)) <= settings.tolerance:
        return True, "residual and load settled"
    if sweep.step == settings.max_sweeps:
        return False, f"residual {sweep.residual:.1e} after {sweep.step} sweeps"
    return None


class _Relaxation:
    """One sweep's steps."""

    def __init__(self, problem, settings):
        self._problem, self._settings = problem, settings
        self._D = influence_coefficients(problem.grid.mesh, problem.contact.kernel, 0, 1)[0, :3]

    def mark_contact(self, state):
        """Contact where the gap is closed, film elsewhere; without interface conditions all film."""
        problem = self._problem
        closed = problem.scheme.contact_law.closed(state.H, was_released=False)
        state.status[:] = np.where(closed, CONTACT, LUBRICATED)
        state.status[problem.boundary] = BOUNDARY
        state.status[enclosed(problem.grid.halo_status(state.status), problem.axes)] = CONTACT

    def mark_cavities(self, state, evaluation):
        """Film without pressure that no fluid flows into is a cavity, whose pressure stays. (Cutting
        negative pressures alone leaves a residual beside it: new pressures answer to cut ones.)"""
        empty = (
            (state.status == LUBRICATED)
            & (state.P <= self._problem.contact.tears_at)
            & (evaluation.inflow <= 0.0)
        )
        state.status[empty & self._problem.scheme.cavitation] = CAVITATED

    def change(self, state, evaluation):
        """P_new - P_old of every node."""
        contact, given = state.status == CONTACT, rows_of(state.status) == PRESSURE
        bands = self._line_bands(evaluation, contact, given)
        rhs = np.where(contact, -state.H, -evaluation.inflow)
        rhs[given] = 0.0
        if not rhs.size:
            return rhs  # a rank without lines: scipy takes no empty system
        # The lines follow each other in one system: their ends are boundary and couple nothing.
        flat = [band.ravel() for band in bands]
        ab = np.zeros((3, rhs.size))
        ab[0, 1:], ab[1], ab[2, :-1] = flat[2][:-1], flat[1], flat[0][1:]
        return solve_banded((1, 1), ab, rhs.ravel(), overwrite_ab=True, check_finite=False).reshape(
            rhs.shape
        )

    def move(self, state, change, step):
        """Go the relaxed part of the way; correct H0 when its turn has come."""
        settings, problem = self._settings, self._problem
        factor = np.where(state.status == CONTACT, settings.contact_share, 1.0) * settings.omega
        state.P += factor * change
        if problem.scheme.cavitation:
            np.maximum(state.P, problem.contact.tears_at, out=state.P)
        if (step + 1) % settings.load_every == 0:
            state.H0 += settings.load_factor * problem.load_deficit(state.P)
        state.H = problem.gap(state.P, state.H0)

    def sweep(self, step, state, evaluation, change):
        """The state before a sweep, as a row of the history."""
        problem, grid = self._problem, self._problem.grid
        residual = problem.rms(residual_of(evaluation, rows_of(state.status)))
        contact = state.status == CONTACT
        moved, new = np.abs(change), np.maximum(state.P + change, 0.0)
        errors = []
        for part in (np.ones_like(contact), ~contact, contact):
            whole = grid.sum(new[part].sum())
            errors.append(grid.sum(moved[part].sum()) / whole if whole > 0.0 else 0.0)
        counts = problem.counts(state.status)
        load = problem.load_deficit(state.P)
        return Sweep(step, residual, load, *problem.films(state), *counts, *errors)

    def _line_bands(self, evaluation, contact, given):
        """Coefficients of P_i-1, P_i, P_i+1 in the equation of node i, each (lines, nx)."""
        settings, D = self._settings, self._D
        alpha, beta, gamma = self._fluid_bands(evaluation)
        if settings.fluid_update == "point":
            alpha, gamma = np.zeros_like(beta), np.zeros_like(beta)
        # By points a contact node answers to the one before it. (Eq. 42 has the line before in it,
        # too: here all lines are relaxed at once, so that ranks do not matter.)
        after = D[1] if settings.contact_update == "line" else 0.0
        alpha = np.where(contact, D[1], alpha)
        beta = np.where(contact, settings.stability * D[0], beta)
        gamma = np.where(contact, after, gamma)
        alpha[given], beta[given], gamma[given] = 0.0, 1.0, 0.0
        return alpha, beta, gamma

    def _fluid_bands(self, evaluation):
        """alpha, beta, gamma of [Liu eq. 52]: mobility held, the gap answering to P."""
        grid, D = self._problem.grid, self._D
        along, across = evaluation.conductances
        is_open = open_faces(is_solid(evaluation.status), evaluation.axes[0])
        carried = own(evaluation.fluid.rho) / grid.mesh.dX
        west, east = (np.zeros(grid.shape) for _ in range(2))
        west[:, 1:], east[:, :-1] = along, along
        entering, leaving = (np.zeros(grid.shape) for _ in range(2))
        entering[:, 1:], leaving[:, :-1] = carried[:, :-1] * is_open, carried[:, :-1] * is_open
        alpha = west - (leaving * D[1] - entering * D[0])
        beta = -(west + east + across[:-1] + across[1:]) - leaving * D[0]
        gamma = east - (leaving * D[1] - entering * D[2])
        # A node that nothing reaches (no mobility, all faces closed) stays where it is.
        beta[beta == 0.0] = -1.0
        return alpha, beta, gamma
