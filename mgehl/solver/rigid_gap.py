"""The fluid alone in a gap that is held fixed: Newton's method, no convolution."""

from dataclasses import dataclass

import numpy as np
from petsc4py import PETSc

from mgehl.discretization.axes import own
from mgehl.discretization.rows import rows_of
from mgehl.discretization.status import CAVITATED, LUBRICATED, is_fluid
from mgehl.grid.events import linear_solve
from mgehl.solver.cavitation import cavities_rest, driven, overflows, relax_cavitation_set
from mgehl.solver.problem import DIVERGED

LARGEST_STEP = 0.3
"""Largest change of a pressure in one step, in p_h: near a fold longer ones lead astray; 0.03 to 3 do."""

LINEAR_TOLERANCE = 0.03
"""Relative tolerance of linear systems of a rigid gap; from 0.01 to 0.1 the same steps within one."""


FLUID_AHEAD = 0.1
"""Residual to which the fluid is solved apart, over that of the rest or, where larger, its tolerance: from
0.01 to 0.3 the same Newton steps within one. Above 1 no solve would end."""


@dataclass(frozen=True)
class FluidStep:
    """The rms inflow before a step and the iterations of the linear solver in it."""

    residual: float
    linear_iterations: int


class RigidGapFluid:
    """Newton's method for the separable fluid alone; `multigrid` solves its linear systems. That is a
    rigid-gap `MultigridSolver`, or an `AssembledSolver`."""

    def __init__(self, problem, multigrid, options_prefix, linear_tolerance=LINEAR_TOLERANCE):
        self._problem, self._multigrid = problem, multigrid
        self._ksp = PETSc.KSP().create(problem.grid.comm)
        self._ksp.setOptionsPrefix(options_prefix)
        multigrid.configure(self._ksp, linear_tolerance)
        self._rhs, self._correction = (multigrid.space.create_vec() for _ in range(2))

    def free(self):
        """Destroy the PETSc objects."""
        for thing in (self._ksp, self._rhs, self._correction):
            thing.destroy()
        self._multigrid.free()

    def separable(self, evaluation, status):
        """Fluid nodes that this solver answers for: (lines, nx) bool. Films under contact pressure are not
        among them: so viscous a fluid is driven out of no gap."""
        return is_fluid(status) & (own(evaluation.fluid.eps) > 0.0) & driven(self._problem, evaluation)

    def solve(self, state, tolerance, max_steps=30, before_step=lambda: None, to_rest=True):
        """Bring the fluid of `state` into balance at its gap, in place; return its `FluidStep`s and the
        `Evaluation` of its last state.

        Ends when the rms inflow is below `tolerance` and the set has settled, or after `max_steps`; the
        last step is the residual that is left. `before_step` is called before each and may raise what ends
        it. A node whose pressure rises until it is no longer separable gets its old pressure back, for the
        caller to solve: who moves the gap needs no cavities that come `to_rest` either.
        """
        problem, steps, before = self._problem, [], state.P.copy()
        evaluation = self._evaluated(state)
        separable, given_back = self.separable(evaluation, state.status), 0
        while True:
            moved = 0 if cavities_rest(problem, state) else relax_cavitation_set(problem, state)
            filled = separable & overflows(state)
            state.status[filled] = LUBRICATED
            if moved or problem.grid.count(filled):
                evaluation = self._evaluated(state)
            solved = separable & (state.status == LUBRICATED) | problem.feeding(state.status)
            residual = np.where(solved, evaluation.inflow, 0.0)
            rms = problem.rms(residual)
            restless = given_back + problem.grid.count(filled) + (moved if to_rest else 0)
            settled = rms <= tolerance and restless == 0
            if settled or len(steps) == max_steps or not rms < DIVERGED:
                return [*steps, FluidStep(rms, 0)], evaluation
            before_step()
            self._correct(state, evaluation, residual, separable)
            steps.append(FluidStep(rms, self._ksp.getIterationNumber()))
            self._tear(state, separable)
            evaluation = self._evaluated(state)
            given_back = self._give_back(state, separable, before, evaluation)
            if given_back:
                evaluation = self._evaluated(state)

    def _tear(self, state, separable):
        """Make cavities, full ones, of `separable` film that pulls, where films may tear."""
        tears_at = self._problem.contact.tears_at
        torn = (state.P < tears_at) & separable & (state.status == LUBRICATED)
        if self._problem.scheme.cavitation:
            state.P[torn], state.status[torn], state.filling[torn] = tears_at, CAVITATED, 1.0

    def _evaluated(self, state):
        """The evaluation of a state whose pressures are the fluid's, contents marched."""
        state.p[:] = state.P
        return self._problem.march_contents(state, self._problem.evaluate(state))

    def _give_back(self, state, separable, before, evaluation):
        """Take nodes that are no longer so out of `separable`, in place; they get P of `before`. Returns
        how many."""
        lost = separable & ~self.separable(evaluation, state.status)
        separable[lost] = False
        state.P[lost] = before[lost]
        return self._problem.grid.count(lost)

    def _correct(self, state, evaluation, residual, separable):
        """One Newton step of the pressure of `separable` film; the other fluid's is held."""
        space, film = self._multigrid.space, state.status == LUBRICATED
        feeding = self._problem.feeding(state.status)
        self._multigrid.linearise(evaluation, rows_of(state.status, True, film & ~separable, feeding))
        space.write(self._rhs, -residual, 0.0)
        with linear_solve():
            self._ksp.solve(self._rhs, self._correction)
        # Elsewhere the correction is zero but for the rounding of an algebraic multigrid.
        solved, step = film & separable, space.read_pressure(self._correction)
        state.filling[feeding] = np.maximum(state.filling[feeding] + step[feeding], 0.0)
        step = step[solved]
        state.P[solved] += np.clip(step, -LARGEST_STEP, LARGEST_STEP) if self._problem.is_elastic else step
