"""The rigid wedge bearing: one linear system for the pressure, or a few where the film cavitates."""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.face_gap import FaceGap
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.rows import GAP, PRESSURE
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.grid.onto import onto
from mgehl.multigrid.assembled import AssembledSolver
from mgehl.solver.outcome import Outcome
from mgehl.solver.problem import Problem, State
from mgehl.solver.rigid_gap import RigidGapFluid


class WedgeProblem(Problem):
    """Gap and contact of a `WedgeBearing` on one grid: both are given."""

    def __init__(self, grid, bearing, scheme):
        super().__init__(grid, bearing, scheme)
        if bearing.closed_sides:
            self.boundary[:, 1:-1] = False
        if bearing.pocket:
            self.gaps = [self._face_gap(axis) for axis in self.axes]

    def _face_gap(self, axis):
        """The `FaceGap` along an axis."""
        X, Y, bearing, cell = self.grid.X, self.grid.Y, self.contact, (self.grid.mesh.dX, self.grid.mesh.dY)
        if not axis.number:
            Y = np.vstack([Y - 0.5 * cell[1], Y[-1:] + 0.5 * cell[1]])
            return FaceGap(*bearing.gap_between(X, Y, *cell, along=False))
        X = 0.5 * (X[:, 1:] + X[:, :-1])
        has_edge, *to_edge = bearing.gap_to_edge(X, Y, *cell)
        return FaceGap(*bearing.gap_between(X, Y, *cell, along=True), has_edge, FaceGap(*to_edge))

    def first_guess(self):
        """The state at ambient pressure; solid nodes have no gap, and no pressure."""
        grid, bearing = self.grid, self.contact
        solid = np.broadcast_to(bearing.solid(grid.X, grid.Y), grid.shape)
        status = np.where(solid, CONTACT, np.where(self.boundary, BOUNDARY, LUBRICATED))
        gap = bearing.mean_gap(grid.X, grid.Y, grid.mesh.dX, grid.mesh.dY)
        H = np.where(solid, 0.0, np.broadcast_to(gap, grid.shape))
        return State(np.where(solid, 0.0, bearing.ambient), 0.0, H, status.astype(np.int8))

    def feeding(self, status):
        """All cavities: no linear system takes a convolution, and the plate may move against the axis."""
        return status == CAVITATED

    def rows(self, status):
        """As of any fluid; no pressure moves the gap of solid nodes, and theirs is given."""
        rows = super().rows(status)
        rows[rows == GAP] = PRESSURE
        return rows

    def residual(self, evaluation, status):
        """As of any fluid; at the pad's edges the pressure is the ambient one."""
        F = super().residual(evaluation, status)
        return F + np.where(status == BOUNDARY, self.contact.ambient / self.grid.mesh.dX, 0.0)


@dataclass(frozen=True)
class Found:
    """An answer on another grid, from which one begins: whole arrays on rank 0, None elsewhere. Grids of a
    bearing share no nodes: each begins half a cell outside of the pad."""

    mesh: Mesh
    P: np.ndarray | None
    filling: np.ndarray | None
    torn: np.ndarray | None

    @classmethod
    def of(cls, problem, state):
        """That of a state (collective)."""
        arrays = state.P, state.filling, (state.status == CAVITATED).astype(float)
        return cls(problem.grid.mesh, *(problem.grid.gather(each) for each in arrays))

    def lay_on(self, problem, state):
        """Lay it on the film of a first guess, in place (collective). Each step moves the edges of cavities
        by a few nodes: from nothing a grid of twice the nodes takes twice the steps."""
        grid, film, tears_at = problem.grid, state.status == LUBRICATED, problem.contact.tears_at
        arrays = self.P, self.filling, self.torn
        if grid.comm.rank == 0:
            arrays = [onto(grid.mesh, self.mesh, each) for each in arrays]
        P, filling, torn = (grid.scatter(each) for each in arrays)
        torn = film & (torn > 0.5)
        state.status[torn] = CAVITATED
        state.P[film] = np.maximum(P[film], tears_at)
        state.P[torn] = tears_at
        state.filling[torn] = np.clip(filling[torn], 0.0, 1.0)


def solve_wedge(grid, bearing, scheme, tolerance, max_steps, before_step=lambda: None, found=None):
    """Solve on `grid`; return the `WedgeProblem` and an `Outcome` of `FluidStep`s. `tolerance` is for the
    rms residual, full film's Couette term being 1; `before_step` may raise what ends the run. It begins
    from what was `Found` on a coarser grid, if that is given."""
    problem = WedgeProblem(grid, bearing, scheme)
    fluid, state = RigidGapFluid(problem, AssembledSolver(grid)), problem.first_guess()
    if found:
        found.lay_on(problem, state)
    try:
        steps = fluid.solve(state, tolerance, max_steps, before_step)
        # Once more: what the first solve left would show in the flow balance.
        if steps[-1].residual <= tolerance:
            steps = steps[:-1] + fluid.solve(state, 0.0, 1)
    finally:
        fluid.free()
    state.filling[state.status != CAVITATED] = 1.0  # what has become film may say more
    left = problem.rms(problem.residual(problem.evaluate(state), state.status))
    converged = bool(left <= tolerance)
    reason = "the residual holds" if converged else f"residual {left:.1e} after {len(steps) - 1} solves"
    return problem, Outcome(state, converged, reason, steps)
