"""The same contact on coarser grids, each solved from the next finer answer: the error of the films follows
from the differences.

A coarse grid of the nested iteration was solved at a speed that it resolves, and not to its end. Here the
speed is the wanted one, and the start is so near that a few steps do. Two coarser grids take some fifteen
per cent of the finest grid's work. For the gaps of rough bodies one coarser grid takes 5 to 30; it sees the
surface as it is, for else it would have another contact.
"""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from mgehl.discretization.status import CONTACT
from mgehl.multigrid.cycle import MultigridSolver
from mgehl.solver.films import Films, films_beside, films_between_nodes
from mgehl.solver.gaps import Gaps, differences, gaps
from mgehl.solver.journal import NOTHING_KEPT
from mgehl.solver.nested import LevelSolve
from mgehl.solver.newton import Newton
from mgehl.solver.problem import ContactProblem

COARSER = 2
"""Grids besides the finest: two differences show whether the error falls as the scheme's does."""

TOLERANCE, MAX_STEPS = 1e-5, 10
"""Largest residual and most steps on the coarser grids. With a residual of 1e-4 a thick film is off by half
a per cent (3 m/s, 65 nodes). Four steps are usual; where ten do not settle there is no film to compare
with."""

SPREADING_STEPS = 3
"""Steps in which contact may spread there. Of 500 such solves twelve came to contact that spread so often,
and none of these settled. Eight settled with contact on the way: it spread in two steps at the most."""


MAX_STEPS_OF_ROUGH = 40
"""The same of rough bodies' gaps. Of 17 balls on 129 nodes 16 settled in 3 to 17 steps; the
other, at 0.05 mm/s, did not in 40."""


@dataclass(frozen=True)
class GridFilms:
    """A grid's answer at the wanted speed."""

    nodes: int
    films: Films
    contact_nodes: int
    settled: bool

    @property
    def is_film(self):
        """Whether the whole contact has a film there."""
        return self.settled and not self.contact_nodes


@dataclass(frozen=True)
class GridGaps:
    """A grid's answer of rough bodies."""

    nodes: int
    gaps: Gaps
    contact_load_share: float
    settled: bool
    differences: Gaps | None = None
    """Of a coarser grid: the mean sizes by which its gaps differ from the finer one's."""


def films_of_grids(hierarchy, problem, state, settings, scheme, monitor, journal=NOTHING_KEPT):
    """`GridFilms` of the finest grid, whose answer is `state`, and of the next coarser ones (collective).

    Those are solved by a `Scheme` that may be another. The list ends with the first grid that has contact,
    or no answer. `monitor` and `journal` as of `nested_iteration`.
    """
    films, contact = films_between_nodes(problem, state), problem.contact
    limits = replace(settings.newton, max_steps=MAX_STEPS, spreading_steps=SPREADING_STEPS)
    found = [_grid_films(problem, state, films, True)]
    last = len(hierarchy.grids) - 1
    for level in range(last - 1, max(last - 1 - COARSER, -1), -1):
        H = hierarchy.transfers[level].inject(state.H)
        seen = contact.seen_by(hierarchy.grids[level].mesh, hierarchy.grids[-1].mesh)
        problem, state = _injected(hierarchy, level, seen, state, scheme)
        outcome = _solve(hierarchy, level, problem, state, settings, monitor, journal, limits)
        state, films = outcome.state, films_beside(problem, outcome.state, films, H)
        found.append(_grid_films(problem, state, films, outcome.converged))
        if not found[-1].is_film:
            break
    return found


def gaps_of_grids(hierarchy, problem, state, settings, monitor, journal=NOTHING_KEPT):
    """`GridGaps` of the finest grid, whose answer is `state`, and of the next coarser one, if there is one
    (collective); otherwise as `films_of_grids`."""
    found, level = [_grid_gaps(problem, state, True)], len(hierarchy.grids) - 2
    if level >= 0:
        H, scheme = hierarchy.transfers[level].inject(state.H), problem.scheme
        problem, state = _injected(hierarchy, level, problem.contact, state, scheme)
        touch = problem.scheme.lets_peaks_touch(problem.contact)
        limits = settings.newton.squeezed() if touch else settings.newton
        limits = replace(limits, max_steps=MAX_STEPS_OF_ROUGH)
        outcome = _solve(hierarchy, level, problem, state, settings, monitor, journal, limits)
        apart = differences(problem, outcome.state, H)
        found.append(_grid_gaps(problem, outcome.state, outcome.converged, apart))
    return found


def _grid_gaps(problem, state, settled, apart=None):
    share = problem.share_of_load(state.P, state.status == CONTACT)
    return GridGaps(problem.grid.mesh.nx, gaps(problem, state), share, settled, apart)


def _grid_films(problem, state, films, settled):
    contact_nodes, _ = problem.counts(state.status)
    return GridFilms(problem.grid.mesh.nx, films, contact_nodes, settled)


def _injected(hierarchy, level, contact, state, scheme):
    """The problem of a contact on a coarser grid, and the finer state at its nodes."""
    transfer, grid = hierarchy.transfers[level], hierarchy.grids[level]
    status = transfer.inject(state.status.astype(float)).astype(np.int8)
    coarser = ContactProblem(grid, hierarchy.deflections[level], contact, scheme)
    return coarser, coarser.state(transfer.inject(state.P), state.H0, status)


def _solve(hierarchy, level, problem, state, settings, monitor, journal, limits):
    """The `Outcome` of a grid by these `NewtonSettings`, but for the tolerance; Eq. 2 lets nothing go."""
    limits = replace(limits, tolerance=max(TOLERANCE, limits.tolerance), release_budget=0)
    multigrid = MultigridSolver(hierarchy, level, problem.contact, problem.scheme, settings.cycle)
    tell = partial(monitor, LevelSolve(problem.grid.mesh.nx, problem.contact.speed, False))
    newton = Newton(problem, multigrid, limits, None, settings.cycle.options_prefix, tell)
    try:
        return newton.run(state, journal)
    finally:
        newton.free()
