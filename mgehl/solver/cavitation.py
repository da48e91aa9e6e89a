"""The fluid and its cavitation boundary with the gap held fixed: no convolution.

A Newton step moves the boundary by one layer of nodes, and the far field alone may need dozens.
Where Poiseuille flow dominates, H hardly depends on P, so the complementarity problem
P >= 0, net inflow <= 0 can be solved there at the present gap, by projected line sweeps (near
the answer) or by Newton's method with the multigrid of a rigid gap (far from it).
"""

import numpy as np
from petsc4py import PETSc

from mgehl.discretization.fluid import FACE_MEANS, fluid_state
from mgehl.discretization.kernels import flow_sources, relax_cavitation
from mgehl.discretization.status import BOUNDARY, CAVITATED, LUBRICATED, open_x_faces, open_y_faces

WEAKLY_COUPLED = 10.0
"""A node is relaxed where its mobility/dX exceeds this multiple of its own influence."""

SEPARABLE = 1e-5
"""The same for a node that is solved apart from the gap: all but films under contact pressure,
whose viscosity makes them stiff (measured: the smaller, the fewer steps; 0.01 to 10 work too)."""

LINEAR_TOLERANCE = 0.03
"""Of the linear systems of a rigid gap."""

SWEEPS = 40
"""Sweeps over all lines at the most; they end when one changes no status."""

PASSES = 2
"""Set iterations on a line in each sweep."""


def relax_cavitation_set(problem, state, inflow):
    """Relax P and status of the weakly coupled fluid; return the number of nodes that changed.

    Updates `state` in place, but only if the set moved: otherwise Newton's pressures stand.
    Zebra order by global line number, so the number of ranks does not matter.
    """
    grid, mesh = problem.grid, problem.grid.mesh
    P, H, status = (grid.halo(array) for array in (state.P, state.H, state.status))
    eps = fluid_state(P, H, problem.contact).eps
    along, across = _conductances(eps, status, mesh, FACE_MEANS[problem.scheme.face_mobility])
    movable = weakly_coupled(problem, eps[1:-1], state.status, WEAKLY_COUPLED)
    lubricated = state.status == LUBRICATED
    source = np.zeros(grid.shape)
    flow_sources(inflow, P, along, across, source)
    for _ in range(SWEEPS):
        changes = 0
        for colour in (0, 1):
            first = (colour + grid.first) % 2
            changes += relax_cavitation(first, P, lubricated, movable, source, along, across, PASSES)
            grid.refresh(P)
        if grid.sum(changes) == 0:
            break
    relaxed = np.where(movable, np.where(lubricated, LUBRICATED, CAVITATED), state.status)
    moved = grid.count(relaxed != state.status)
    if moved:
        state.P[:] = P[1:-1]
        state.status[:] = relaxed
    return moved


def weakly_coupled(problem, eps, status, multiple):
    """Fluid nodes whose gap hardly answers to their pressure; all (lines, nx)."""
    fluid = (status == LUBRICATED) | (status == CAVITATED)
    return fluid & (eps > multiple * problem.K00 * problem.grid.mesh.dX)


def _conductances(eps, status, mesh, mean):
    """Mobility of the x faces over dX^2 and of the y faces over dY^2, zero where closed."""
    inner = eps[1:-1]
    along = mean(inner[:, :-1], inner[:, 1:])[0] * open_x_faces(status[1:-1]) / mesh.dX**2
    across = mean(eps[:-1], eps[1:])[0] * open_y_faces(status) * (mesh.k_e / mesh.dY) ** 2
    return along, across


class RigidGapFluid:
    """Newton's method for the separable fluid alone; `multigrid` is a rigid-gap solver."""

    def __init__(self, problem, multigrid, options_prefix):
        self._problem, self._multigrid = problem, multigrid
        self._ksp = PETSc.KSP().create(problem.grid.comm)
        self._ksp.setOptionsPrefix(options_prefix)
        multigrid.configure(self._ksp, LINEAR_TOLERANCE)
        self._rhs, self._correction = (multigrid.space.create_vec() for _ in range(2))

    def free(self):
        """Destroy the PETSc objects."""
        for thing in (self._ksp, self._rhs, self._correction):
            thing.destroy()
        self._multigrid.free()

    def separable(self, state):
        """Fluid nodes that this solver answers for: (lines, nx) bool."""
        eps = fluid_state(state.P, state.H, self._problem.contact).eps
        return weakly_coupled(self._problem, eps, state.status, SEPARABLE)

    def solve(self, state, tolerance, max_steps=30):
        """Bring the fluid of `state` into balance at its gap, in place.

        Ends when the rms inflow is below `tolerance` and the set has settled, or after
        `max_steps`.
        """
        problem, space = self._problem, self._multigrid.space
        separable = self.separable(state)
        for _ in range(max_steps):
            inflow = problem.inflow(state)
            moved = relax_cavitation_set(problem, state, inflow)
            if moved:
                inflow = problem.inflow(state)
            filled = separable & (state.status == CAVITATED) & (inflow > 0.0)
            state.status[filled] = LUBRICATED
            lubricated = state.status == LUBRICATED
            residual = np.where(separable & lubricated, inflow, 0.0)
            if problem.rms(residual) <= tolerance and moved + problem.grid.count(filled) == 0:
                return
            given = lubricated & ~separable
            self._multigrid.linearise(state.P, state.H, np.where(given, BOUNDARY, state.status))
            space.write(self._rhs, -residual, 0.0)
            self._ksp.solve(self._rhs, self._correction)
            state.P += space.read(self._correction)[0]
            torn = (state.P < 0.0) & separable
            state.P[torn] = 0.0
            state.status[torn] = CAVITATED
