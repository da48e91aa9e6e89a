"""Newton's method for one grid, the sets re-partitioned between its steps.

A python-type SNES, so that PETSc's options, monitors and viewers of SNES, KSP and PC apply.
"""

import numpy as np
from petsc4py import PETSc

from mgehl.discretization.status import BOUNDARY, LUBRICATED
from mgehl.errors import OptionError, Stopped, UserError
from mgehl.grid.events import linear_solve
from mgehl.solver.arbiter import arbitrate, closed_again, release_early, restore_answer
from mgehl.solver.cavitation import relax_cavitation_set, split_flow
from mgehl.solver.journal import NOTHING_KEPT
from mgehl.solver.outcome import Cycle, Outcome, Position
from mgehl.solver.partition import Changes, Partition
from mgehl.solver.problem import DIVERGED
from mgehl.solver.squeeze import squeeze_rates

FLUID_SHARE = 0.3
"""Part of the tolerance that the fluid solved apart may use up: 0.3^2 of the mean square."""

FLUID_AHEAD = 0.1
"""Residual of the fluid solved apart beside that of the last cycle."""

FIRST_RESIDUAL = 1e-3
"""What a contact start is expected to begin with."""

STALLS = 3
"""Linear systems that GMRES may leave unsolved: where no state is near (a film that ends, a node at a
fold) all that follow cost as much as they can and lead nowhere."""


class Newton:
    """Solves one `ContactProblem` with a `MultigridSolver`.

    `solve` holds the iteration, because the sets change within it. SNES is given the function and
    the Jacobian of the present partition besides, for its viewers and whoever probes it.

    With a `fluid` solver (`RigidGapFluid`) the separable fluid is solved at each new gap, without
    convolutions, and left out of the linear systems: right where solid contact carries the load.
    `monitor` is called with every `Cycle`. PETSc objects are freed by `free`.
    """

    def __init__(self, problem, multigrid, settings, fluid=None, options_prefix="mgehl_", monitor=None):
        self._problem, self._multigrid, self._settings = problem, multigrid, settings
        self._fluid, self._monitor = fluid, monitor or (lambda cycle: None)
        self._partition = Partition(problem, settings.film_threshold, settings.release_budget)
        self._snes = PETSc.SNES().create(problem.grid.comm)
        self._snes.setOptionsPrefix(options_prefix)
        self._snes.setType(PETSc.SNES.Type.PYTHON)
        self._snes.setPythonContext(self)
        self._unknown, self._rhs, self._correction = (multigrid.space.create_vec() for _ in range(3))
        self._snes.setFunction(self._form_function, self._rhs)
        self._snes.setJacobian(self._form_jacobian, multigrid.jacobian.mat)
        self._snes.setTolerances(atol=settings.tolerance, rtol=0.0, max_it=settings.max_steps)
        multigrid.configure(self._snes.getKSP(), settings.linear_tolerance)
        self._snes.setFromOptions()
        if self._snes.getType() != PETSc.SNES.Type.PYTHON:
            self.free()
            raise OptionError(f"-{options_prefix}snes_type: the solver is the SNES type python, no other")

    def free(self):
        """Destroy the PETSc objects, the multigrid solver's too: the KSP refers to them.

        (Not called `destroy`: PETSc calls a context's method of that name.)
        """
        for thing in (self._snes, self._unknown, self._rhs, self._correction):
            thing.destroy()
        self._multigrid.free()

    def run(self, state, journal=NOTHING_KEPT):
        """Solve from `state`, which is not changed; return the `Outcome`.

        The `journal` is told of every step, and may know this solve or its first part already.
        """
        grid, self._journal = self._problem.grid, journal
        outcome = journal.recall(grid)
        if outcome is None:
            self._now = journal.standing(grid) or self._beginning(state.copy())
            self._partition.past = self._now.past
            self._halted = None
            self._snes.solve(None, self._unknown)
            if self._halted:
                raise self._halted
            outcome = self._now.outcome
            journal.finish(grid, outcome)
        return outcome

    def _beginning(self, state):
        """The `Position` before anything was done."""
        limit = self._snes.getTolerances()[3]
        now = Position(Outcome(state, False, ""), self._partition.past, limit)
        self._partition.enter_contact(state, now.changes)
        return now

    def solve(self, snes, _b, x):
        """The nonlinear iteration (called by PETSc, through which no exception should pass)."""
        reasons = PETSc.SNES.ConvergedReason
        try:
            self._iterate(snes)
        except (Stopped, UserError) as halted:
            self._halted = halted
        outcome = self._now.outcome
        self._multigrid.space.write(x, outcome.state.P, outcome.state.H0)
        snes.setConvergedReason(
            reasons.CONVERGED_FNORM_ABS if outcome.converged else reasons.DIVERGED_MAX_IT
        )

    def _iterate(self, snes):
        """Go on from the present position to the end."""
        _, tolerance, _, max_steps = snes.getTolerances()
        now, problem = self._now, self._problem
        outcome = now.outcome
        while True:
            self._journal.step(problem.grid, now)
            state = outcome.state
            F, load = self._settle(state, now.changes)
            if self._fluid and now.changes.total == 0 and problem.rms(F) <= tolerance:
                # The fluid was solved at the gap before: what counts is F at its own.
                state.H = problem.gap(state.P, state.H0)
                F = problem.residual(state, problem.inflow(state))
            cycle = self._tell(F, load)
            now.entered += now.changes.entered
            now.changes = Changes()
            if self._finished(outcome, tolerance, now.limit):
                if not arbitrate(self._partition, now, max_steps):
                    break
                F, load = self._settle_released(state, now.changes)
            elif self._fluid and release_early(self._partition, now):
                F, load = self._settle_released(state, now.changes)
            elif closed_again(now):
                break
            now.linear_iterations = self._correct(snes, state, F, load)
            reason = snes.getKSP().getConvergedReason()
            if now.answer and reason < 0:
                break  # what Eq. 2 let go leaves no system that can be solved
            now.stalls += reason == PETSc.KSP.ConvergedReason.DIVERGED_MAX_IT
            if reason == PETSc.KSP.ConvergedReason.DIVERGED_NANORINF:
                outcome.reason = f"singular: no linear solution after {cycle.step} steps"
                break
            now.step_length = self._update(state, now.changes)
        if now.answer and not outcome.converged:
            self._restore(now)

    def _settle(self, state, changes):
        """Settle the fluid at the present gap; return the residual and the load deficit."""
        problem = self._problem
        if self._fluid:
            before = state.status.copy()
            self._fluid.solve(state, self._fluid_tolerance)
            changes.cavitated += problem.grid.count(before != state.status)
        inflow = problem.inflow(state)
        moved = relax_cavitation_set(problem, state, split_flow(problem, state, inflow))
        if moved:
            changes.cavitated += moved
            inflow = problem.inflow(state)
        self._partition.fill(state, inflow, changes)
        return problem.residual(state, inflow), problem.load_deficit(state.P)

    def _settle_released(self, state, changes):
        """As `_settle`, where nodes that had no gap have just become film."""
        state.H = self._problem.gap(state.P, state.H0)
        return self._settle(state, changes)

    @property
    def _fluid_tolerance(self):
        """Of the fluid solved apart: well ahead of the rest, whose next step moves the gap anyway."""
        cycles = self._now.outcome.cycles
        reached = cycles[-1].residual if cycles else 1.0
        return max(FLUID_SHARE * self._settings.tolerance, FLUID_AHEAD * min(reached, FIRST_RESIDUAL))

    def _correct(self, snes, state, F, load):
        """Solve the linearised bordered system into `_correction`; return the iterations."""
        status = state.status
        if self._fluid:
            flow = split_flow(self._problem, state, F)  # F is the inflow of the film
            settled = (status == LUBRICATED) & self._fluid.separable(state, flow)
            status, F = np.where(settled, BOUNDARY, status), np.where(settled, 0.0, F)
        rates = squeeze_rates(self._problem, state, F, self._settings)
        self._multigrid.linearise(state.P, state.H, status, rates)
        self._write_residual(self._rhs, F, load, sign=-1.0)
        ksp = snes.getKSP()
        with linear_solve():
            ksp.solve(self._rhs, self._correction)
        return ksp.getIterationNumber()

    def _update(self, state, changes):
        """Take the step, cut tension, let gaps close; return the step length."""
        problem = self._problem
        dP, dH0 = self._multigrid.space.read(self._correction)
        largest = problem.grid.max(np.abs(dP), initial=0.0)
        length = min(1.0, self._settings.max_pressure_step / max(largest, 1e-300))
        state.P += length * dP
        state.H0 += length * dH0
        self._partition.cut_tension(state.P, state.status, changes)
        state.H = problem.gap(state.P, state.H0)
        self._partition.enter_contact(state, changes)
        return length

    def _finished(self, outcome, tolerance, max_steps):
        """Decide on the last cycle; sets `converged` and `reason`."""
        cycle = outcome.cycles[-1]
        small = cycle.residual <= tolerance and abs(cycle.load_error) <= tolerance
        outcome.converged = small and cycle.changes.total == 0
        if outcome.converged:
            outcome.reason = "residual, load and sets settled"
        elif not cycle.residual < DIVERGED:
            outcome.reason = f"diverged: residual {cycle.residual:.1e} after {cycle.step} steps"
        elif self._partition.restless:
            outcome.contradictions = self._partition.contradictions(outcome.state.status)
            outcome.reason = (
                f"{len(outcome.contradictions)} nodes can be neither film, whose gap closes, nor "
                f"contact, which is torn open: the sets cycle after {cycle.step} steps"
            )
        elif self._now.stalls == STALLS:
            outcome.reason = f"{STALLS} linear systems in {cycle.step} steps could not be solved"
        elif cycle.step >= max_steps:
            settled = "sets still change after" if small else f"residual {cycle.residual:.1e} after"
            outcome.reason = f"{settled} {cycle.step} steps"
        else:
            return False
        return True

    def _restore(self, now):
        """Make a kept answer the outcome, and its state the last of the history."""
        restore_answer(now)
        state = now.outcome.state
        now.changes, now.linear_iterations, now.step_length = Changes(), 0, 0.0
        F = self._problem.residual(state, self._problem.inflow(state))
        self._tell(F, self._problem.load_deficit(state.P))

    def _tell(self, F, load):
        """Add the present state to the history, tell the monitors; return the `Cycle`."""
        now, problem, snes = self._now, self._problem, self._snes
        cycles, state = now.outcome.cycles, now.outcome.state
        cycle = Cycle(
            len(cycles), problem.rms(F), load, *problem.films(state), *problem.counts(state.status),
            now.changes, now.linear_iterations, now.step_length,
        )  # fmt: skip
        cycles.append(cycle)
        self._monitor(cycle)
        snes.setIterationNumber(cycle.step)
        snes.setFunctionNorm(cycle.residual)
        snes.monitor(cycle.step, cycle.residual)
        return cycle

    def _form_function(self, _snes, x, f):
        """f = bordered residual at x for the present partition."""
        P, H0 = self._multigrid.space.read(x)
        state = self._problem.state(P, H0, self._now.outcome.state.status)
        F = self._problem.residual(state, self._problem.inflow(state))
        self._write_residual(f, F, self._problem.load_deficit(P))

    def _form_jacobian(self, _snes, x, _J, _preconditioner):
        """Linearise at x for the present partition."""
        P, H0 = self._multigrid.space.read(x)
        state = self._problem.state(P, H0, self._now.outcome.state.status)
        self._multigrid.linearise(state.P, state.H, state.status)

    def _write_residual(self, vec, F, load, sign=1.0):
        self._multigrid.space.write(vec, sign * F, sign * load * self._multigrid.jacobian.load_scale)
