"""The fluid's pressure under contact, eliminated from the linear system.

Under contact that keeps layers p answers to the flow balance, P to the gap. The balance of all these nodes,
coupled to the rest by their rims, is a sparse system L p = ..., which the first rank factors:

    J' = J - C L^-1 R        R: rows of the nodes under contact, C: columns of their p
"""

import numpy as np
from scipy.sparse import diags
from scipy.sparse.linalg import splu

from mgehl.discretization.mesh import HALO
from mgehl.grid.events import NEARBY, event
from mgehl.grid.node_set import NodeSet

ROUNDING = 1e-12
"""Part of its diagonal that a singular L leaks besides."""


class UnderContact:
    """p of the contact nodes, `touching` (ghosted), of a `Linearisation` with a `Leak` (the team's)."""

    @event(NEARBY)
    def __init__(self, grid, linearisation, touching):
        leak = linearisation.leak
        self._grid, self._leak, self._touching = grid, leak, touching
        self._nodes = NodeSet.where(grid, leak.nodes)
        self.here, self.some = leak.nodes, len(self._nodes) > 0
        """Which own nodes are under contact, and whether any rank has some."""
        if not self.some:
            return
        offsets = linearisation.offsets
        j, i = np.nonzero(leak.nodes)
        line, node = offsets.T
        self._places = (j + HALO + line[:, None], np.clip(i + node[:, None], 0, grid.mesh.nx - 1))
        self._columns = self._columns_of(leak.into, offsets)
        rows = self._gathered(leak.A)
        if self._nodes.here:
            self._lu = factored(self._nodes.matrix(rows.T, self._nodes, offsets))

    def _columns_of(self, into, offsets):
        """(places of own rows, numbers of contact nodes, derivatives) of C."""
        rows, numbers, values = [], [], []
        first, nx = self._grid.first, self._grid.mesh.nx
        for (line, node), derivative in zip(offsets, into, strict=True):
            j, i = np.nonzero(derivative)
            rows.append(j * nx + i)
            numbers.append((first + j + line) * nx + i + node)
            values.append(derivative[j, i])
        places = self._nodes.places(np.concatenate(numbers))
        return np.concatenate(rows), places, np.concatenate(values)

    def _gathered(self, values):
        """What the ranks have of own nodes, (..., own nodes), on the first one."""
        parts = self._grid.team.gather(values)
        return np.concatenate(parts, axis=-1) if self._nodes.here else None

    def inflow(self, answers, dH, dH0):
        """R: into the own contact nodes, of changes of what answers around them, and of gaps, ghosted."""
        return (self._leak.A * answers[self._places] + self._leak.B * (dH[self._places] + dH0)).sum(axis=0)

    def solve(self, inflow):
        """L^-1 of an inflow of own contact nodes: of all contact nodes, on every rank."""
        whole = self._gathered(inflow)
        return self._grid.team.bcast(self._lu.solve(whole) if self._nodes.here else None)

    def own(self, values):
        """Those of own contact nodes."""
        return values[self._nodes.mine]

    def feed(self, out, values):
        """Add C times the p of all contact nodes to rows (lines, nx), in place."""
        rows, numbers, derivatives = self._columns
        flat = out.ravel()
        np.add.at(flat, rows, derivatives * values[numbers])

    def subtract(self, out, dP, dH, dH0):
        """out - C L^-1 R of corrections, ghosted, in place. Those of contact nodes are not the fluid's."""
        if self.some:
            around = np.where(self._touching, 0.0, dP)
            self.feed(out, -self.solve(self.inflow(around, dH, dH0)))


def factored(L):
    """LU of the balance L of nodes under contact.

    By Barus so stiff an oil may let 1e-30 of the flow through. Nodes that it shuts in may keep to rounding
    what they have, where L is singular: there p may be anything. Where nothing at all gets through p stays.
    """
    how = {"permc_spec": "MMD_AT_PLUS_A", "diag_pivot_thresh": 0.0}
    nothing = np.abs(L.diagonal()) < np.finfo(float).tiny
    if nothing.any():
        L = L - diags(nothing.astype(float))
    for leaking in (0.0, ROUNDING):
        try:
            return splu((L + diags(leaking * L.diagonal())).tocsc(), **how)
        except RuntimeError:
            continue
    return _NoAnswer()


class _NoAnswer:
    """In place of the LU of a matrix that has none: GMRES ends with it, and the solve says why."""

    def solve(self, rhs):
        """Nothing that is a number."""
        return np.full(np.shape(rhs), np.nan)
