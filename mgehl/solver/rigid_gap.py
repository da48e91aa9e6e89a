"""The fluid in a rigid gap, where films may cavitate: Newton's method, no convolution."""

from dataclasses import dataclass

import numpy as np
from petsc4py import PETSc

from mgehl.discretization.status import CAVITATED, LUBRICATED, is_fluid
from mgehl.grid.events import linear_solve
from mgehl.multigrid.options import OF_A_RUN
from mgehl.solver.cavitation import overflows
from mgehl.solver.problem import DIVERGED

LINEAR_TOLERANCE = 1e-11
"""Reduction of the residual by one linear solve; a second removes what rounding left; 1e-3 would do."""


@dataclass(frozen=True)
class FluidStep:
    """The rms inflow before a step and the iterations of the linear solver in it."""

    residual: float
    linear_iterations: int


class RigidGapFluid:
    """Newton's method for a `Problem` whose gap is given; the linear `solver` is an `AssembledSolver`."""

    def __init__(self, problem, solver):
        self._problem, self._solver = problem, solver
        self._ksp = PETSc.KSP().create(problem.grid.comm)
        self._ksp.setOptionsPrefix(OF_A_RUN)
        solver.configure(self._ksp, LINEAR_TOLERANCE)
        self._rhs, self._correction = (solver.space.create_vec() for _ in range(2))

    def free(self):
        """Destroy the PETSc objects."""
        for thing in (self._ksp, self._rhs, self._correction):
            thing.destroy()
        self._solver.free()

    def solve(self, state, tolerance, max_steps, before_step=lambda: None):
        """Bring the fluid of `state` into balance, in place; return its `FluidStep`s.

        Ends when the rms inflow is below `tolerance` and no cavity overflows, or after `max_steps`; the
        last step is the residual that is left. `before_step` is called before each and may raise what ends
        it.
        """
        problem, steps = self._problem, []
        evaluation = self._evaluated(state)
        while True:
            filled = overflows(state)
            state.status[filled] = LUBRICATED
            restless = problem.grid.count(filled)
            if restless:
                evaluation = self._evaluated(state)
            residual = np.where(is_fluid(state.status), evaluation.inflow, 0.0)
            rms = problem.rms(residual)
            settled = rms <= tolerance and not restless
            if settled or len(steps) == max_steps or not rms < DIVERGED:
                return [*steps, FluidStep(rms, 0)]
            before_step()
            self._correct(state, evaluation, residual)
            steps.append(FluidStep(rms, self._ksp.getIterationNumber()))
            self._tear(state)
            evaluation = self._evaluated(state)

    def _tear(self, state):
        """Make cavities, full ones, of film that pulls, where films may tear."""
        tears_at = self._problem.contact.tears_at
        torn = (state.P < tears_at) & (state.status == LUBRICATED)
        if self._problem.scheme.cavitation:
            state.P[torn], state.status[torn], state.filling[torn] = tears_at, CAVITATED, 1.0

    def _evaluated(self, state):
        """The evaluation of a state whose pressures are the fluid's, contents marched."""
        state.p[:] = state.P
        return self._problem.march_contents(state, self._problem.evaluate(state))

    def _correct(self, state, evaluation, residual):
        """One Newton step of pressures and of contents."""
        space, film = self._solver.space, state.status == LUBRICATED
        feeding = self._problem.feeding(state.status)
        self._solver.linearise(evaluation, self._problem.rows(state.status))
        space.write(self._rhs, -residual, 0.0)
        with linear_solve():
            self._ksp.solve(self._rhs, self._correction)
        # Elsewhere the correction is zero but for the rounding of an algebraic multigrid.
        step = space.read_pressure(self._correction)
        state.filling[feeding] = np.maximum(state.filling[feeding] + step[feeding], 0.0)
        state.P[film] += step[film]
