"""Newton's method for one grid, the sets re-partitioned between its steps.

Residual and Jacobian of the present partition are SNES's own, and the iteration asks SNES for them.
"""

from dataclasses import replace
from functools import partial

import numpy as np
from petsc4py import PETSc

from mgehl.grid.events import linear_solve
from mgehl.solver.cavitation import relax_cavitation_set
from mgehl.solver.elimination import Elimination
from mgehl.solver.journal import NOTHING_KEPT
from mgehl.solver.judge import (
    IDLE_CIRCLE,
    IN_TURN_TOLERANCE,
    UNSOLVED,
    SetsChange,
    how_sets_change,
    judge,
    judge_system,
    judge_work,
    since_lowered,
    to_and_fro,
    way_in_vain,
)
from mgehl.solver.layers import FluidInLayers
from mgehl.solver.outcome import Cycle, Outcome
from mgehl.solver.partition import Changes, Partition
from mgehl.solver.position import Position, Step
from mgehl.solver.remembered import Remembered
from mgehl.solver.snes import PythonSnes
from mgehl.solver.squeeze import squeeze_rates
from mgehl.solver.step_length import as_oil_flows, step_length

ENOUGH = 0.5
"""Part of what a step in time may leave that its last linear system leaves: the rest is Newton's."""


HALF = 0.5
"""Of a step that would lead to and fro."""


class Newton(PythonSnes):
    """Solves one `ContactProblem` with a `MultigridSolver`; the only one who changes its `Position`.
    `monitor` is called with every `Cycle`."""

    def __init__(self, problem, multigrid, settings, monitor=None):
        super().__init__(multigrid, settings)
        self._problem = problem
        self._monitor = monitor or (lambda cycle: None)
        self._load_scale = multigrid.jacobian.load_scale
        self._partition = Partition(problem)
        self._elimination = Elimination(problem, settings)
        self._in_turn = False

    def run(self, state, journal=NOTHING_KEPT, tolerance=None):
        """Solve from `state`, which is the solve's own from now on; return the `Outcome`. The `journal` is
        told of every step, and may know this solve or its first part already. A `tolerance` is this solve's
        alone."""
        self._tolerance = self._settings.tolerance if tolerance is None else tolerance
        grid, self._journal = self._problem.grid, journal
        outcome = journal.recall(grid, partial(Outcome.from_record, line=Cycle))
        if outcome is None:
            standing = journal.standing(grid, Position.from_record)
            outcome = self._go_on(standing or self._beginning(state))
            journal.finish(grid, outcome)
        return outcome

    def remembered(self, kept):
        """What the linear solver remembers from now on: first what was `kept`, a `Record` or None."""
        memory = self._multigrid.memory and Remembered(self._multigrid)
        if memory and kept:
            memory.take_back(kept)
        return memory

    def _go_on(self, position):
        """Let SNES solve from a position; return the `Outcome`."""
        self._position, self._partition.past = position, position.past
        position.memory = self.remembered(position.memory)
        self._let_it_solve()
        return self._outcome

    def _beginning(self, state):
        """The `Position` before anything was done."""
        self._partition.forget()
        position = Position(state, self._partition.past)
        self._partition.enter_contact(state, position.changes)
        return position

    def _iterate(self):
        """One solve from top to bottom."""
        position, partition = self._position, self._partition
        limits = replace(self._settings, tolerance=self._tolerance)
        while True:
            self._journal.step(self._problem.grid, position)
            self._settle()
            self._measure()
            verdict = judge(position, partition, limits, self._rounding)
            verdict = judge_work(verdict, self._multigrid.work, self._settings.max_work)
            if not verdict.ends:
                verdict = judge_system(self._correct(), position)
            if verdict.ends:
                break
            self._step()
        self._conclude(verdict)

    def _settle(self):
        """Bring the fluid, its cavities and their pressures to rest at the present gap."""
        problem, state, changes = self._problem, self._position.state, self._position.changes
        how = how_sets_change(self._position, self._settings.by_film)
        self._in_turn = how is SetsChange.IN_TURN
        if how is SetsChange.AT_REST:
            changes.cavitated += relax_cavitation_set(problem, state)
        self._evaluation = problem.march_contents(state, problem.evaluate(state))
        if self._partition.fill(state, changes, self._in_turn):
            self._partition.fit(state)
            self._evaluation = problem.evaluate(state)

    def _measure(self):
        """Evaluate the residual of the present state; add a row to the history."""
        self._tell(*self._compute_function())
        self._position.changes = Changes()

    def _rounding(self):
        """The residual that rounding may leave of the present state."""
        return self._problem.rounding(self._evaluation, self._position.state.status)

    def _correct(self):
        """Solve the linearised bordered system; return the `KSP.ConvergedReason`."""
        position, ksp = self._position, self._snes.getKSP()
        self._f.copy(self._rhs)
        F = self._pose()
        self._snes.computeJacobian(self._unknown, *ksp.getOperators())
        self._leave_out_the_layers(F)
        self._space.write_pressure(self._rhs, F)
        ksp.setTolerances(rtol=self._how_finely())
        with linear_solve():
            ksp.solve(self._rhs, self._correction)
        self._multigrid.forget()
        position.step = Step(ksp.getIterationNumber())
        reason = ksp.getConvergedReason()
        if reason == PETSc.KSP.ConvergedReason.DIVERGED_MAX_IT:
            position.stalls += ksp.getResidualNorm() > UNSOLVED * self._rhs.norm()
        return reason

    def _how_finely(self):
        """The relative tolerance of the next linear system."""
        if self._in_turn:
            return min(self._linear_tolerance, IN_TURN_TOLERANCE)
        if not self._settings.in_time:
            return self._linear_tolerance
        asked = self._tolerance
        left = ENOUGH * asked / max(self._position.cycles[-1].residual, asked)
        return max(self._linear_tolerance, left)

    def _pose(self):
        """Pose the linear system: rows, 1/time step; return its right-hand side, (lines, nx)."""
        problem, status = self._problem, self._position.state.status
        F, rows = self._space.read_pressure(self._f).copy(), problem.rows(status)
        rates = squeeze_rates(problem, self._evaluation, rows, F, self._settings)
        if problem.storage is not None:
            rates = rates + problem.storage.rate
        self._posed = rows, rates
        return F

    def _leave_out_the_layers(self, F):
        """Take the fluid's pressure under contact out of the system, whose right-hand side is `F`."""
        eliminated, self._layers = self._multigrid.jacobian.under_contact, None
        if eliminated is not None and eliminated.some:
            self._layers = FluidInLayers(self._problem, self._evaluation, eliminated)
            self._layers.leave(F)

    def _step(self):
        """Take the step, cut tension, let gaps close."""
        problem, position = self._problem, self._position
        state, changes = position.state, position.changes
        c, dH0 = self._space.read(self._correction)
        asked = dP = self._multigrid.jacobian.pressures(c)
        if self._falls_as_oil_flows:
            dP = as_oil_flows(problem, self._evaluation, state, asked)
        where = problem, self._partition, self._evaluation, state
        length, H, dH = step_length(*where, dP, dH0, self._settings, self._in_turn)
        if to_and_fro(position):
            length, H = HALF * length, None
        if self._layers:
            self._layers.follow(state, c, dH, length, self._settings.passes_on)
        state.P -= length * dP
        state.H0 -= length * dH0
        state.filling -= length * (c - asked)
        self._partition.cut_tension(state, changes, self._in_turn)
        state.H = problem.gap(state.P, state.H0) if H is None else H
        helps = self._helps
        self._partition.passes_on = self._settings.passes_on and helps
        self._partition.follow_gap(state, changes, self._in_turn)
        position.step = replace(position.step, length=length)
        if self._settings.eliminates and helps:
            self._elimination.of(state, changes, self._in_turn)

    @property
    def _helps(self):
        """Whether this step's sets are passed on, and few nodes solved by themselves. That and the steps of
        all may go round: of sixteen steps in vain the last eight go without."""
        return way_in_vain(self._position) // IDLE_CIRCLE % 2 == 0

    @property
    def _falls_as_oil_flows(self):
        """Whether pressures fall as the viscosity lets them in this step."""
        settings, in_vain = self._settings, since_lowered(self._position)
        return settings.by_reduced_pressure and (settings.in_time or bool(in_vain))

    def _conclude(self, verdict):
        """The `Outcome`, and what SNES is told of it."""
        position, reasons = self._position, PETSc.SNES.ConvergedReason
        contradictions = list(verdict.contradictions)
        self._partition.fit(position.state)  # what waited for its turn waits no more
        found = verdict.converged, verdict.reason, position.cycles, contradictions
        self._outcome = Outcome(position.state, *found)
        self._snes.setConvergedReason(
            reasons.CONVERGED_FNORM_ABS if verdict.converged else reasons.DIVERGED_MAX_IT
        )

    def _tell(self, F, load):
        """Add the present state to the history, tell the monitors."""
        snes, problem, status = self._snes, self._problem, self._position.state.status
        cycle = self._position.row(
            problem, problem.with_flow_under_contact(F, self._evaluation, status), load
        )
        self._position.cycles.append(cycle)
        self._monitor(cycle)
        snes.setIterationNumber(cycle.step)
        snes.setFunctionNorm(cycle.residual)
        snes.monitor(cycle.step, cycle.residual)

    def _compute_function(self):
        """Residual (lines, nx) and load deficit of the present state, from SNES's function."""
        state = self._position.state
        self._space.write(self._unknown, self._unknowns(state), state.H0)
        self._snes.computeFunction(self._unknown, self._f)
        F, load = self._space.read(self._f)
        return F, load / self._load_scale

    def _form_function(self, _snes, x, f):
        """f = bordered residual at x for the present partition."""
        problem, status = self._problem, self._position.state.status
        evaluation, (z, H0) = self._evaluated(x), self._space.read(x)
        P = np.where(problem.feeding(status), problem.contact.tears_at, z)
        F, load = problem.residual(evaluation, status), problem.load_deficit(P, H0)
        self._space.write(f, F, load * self._load_scale)

    def _form_jacobian(self, _snes, x, _J, _preconditioner):
        """Linearise at x, for the linear system that is posed."""
        evaluation, resistance = self._evaluated(x), self._problem.resistance_at(self._space.read(x)[1])
        self._multigrid.linearise(evaluation, *self._posed, resistance)

    def _evaluated(self, x):
        """The `Evaluation` at x: of the present state it is known, anything else takes a convolution."""
        z, H0 = self._space.read(x)
        problem, state = self._problem, self._position.state
        if H0 == state.H0 and problem.grid.count(z != self._unknowns(state)) == 0:
            return self._evaluation
        feeds = problem.feeding(state.status)
        P, filling = np.where(feeds, problem.contact.tears_at, z), np.where(feeds, z, state.filling)
        return problem.evaluate(problem.state(P, H0, state.status, state.p, filling))

    def _unknowns(self, state):
        """What SNES has of a state: pressures, and the fillings of cavities that feed a film."""
        return np.where(self._problem.feeding(state.status), state.filling, state.P)
