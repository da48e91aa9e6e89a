"""Mean gaps of rough bodies, film and contact alike, so that different grids can be compared.

Which nodes are in contact changes from grid to grid where gaps hardly differ, and with it the load on
contact and the mean of the film beside it. The mean of all gaps does not care what a gap is called. It
converges as a film does.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.solver.record import Kept


@dataclass(frozen=True)
class Gaps(Kept):
    """Two mean gaps in units of H."""

    mean: float
    """Of all nodes within the Hertz ellipse, or a line contact's width."""
    loaded: float
    """Of all nodes by their pressure: the gap on which the load rests."""


def within_hertz(mesh):
    """Nodes within the Hertz ellipse, or a line contact's width: (ny, nx)."""
    across = np.zeros(1) if mesh.is_line else mesh.Y
    return mesh.X[None, :] ** 2 + across[:, None] ** 2 <= 1.0


def gaps_of(mesh, P, H):
    """`Gaps` of the whole grid's pressure and gap, each (ny, nx)."""
    return Gaps(float(np.mean(H[within_hertz(mesh)])), _loaded(P, H))


def gaps(problem, state):
    """`Gaps` of a state (collective): rank 0 tells the others, so they do not depend on their number."""
    grid = problem.grid
    P, H = grid.gather(state.P), grid.gather(state.H)
    return grid.comm.bcast(None if P is None else gaps_of(grid.mesh, P, H))


def differences(problem, state, H):
    """Means of the sizes by which the gaps of a state's nodes differ from a finer grid's `H` there,
    (lines, nx): `Gaps`, too (collective)."""
    grid = problem.grid
    P, size = grid.gather(state.P), grid.gather(np.abs(state.H - H))
    return grid.comm.bcast(None if P is None else gaps_of(grid.mesh, P, size))


def _loaded(P, H):
    load = P.sum()
    return float(np.vdot(P, H) / load) if load > 0.0 else float("nan")
