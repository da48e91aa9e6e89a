"""Cliffs of the mobility, and a direct solve of the nodes around them.

At the pressure spike of a thick film a mobile node acts on a stiff one, which hardly acts back: lines in
any order leave waves of two cells across it. The near part of J Q among the few nodes beside the arc is a
sparse matrix. The first rank factors it, the last one the coarsest grid's (`coarse`).
"""

from contextlib import suppress

import numpy as np
from scipy.sparse.linalg import splu

from mgehl.discretization.axes import own
from mgehl.discretization.mesh import HALO
from mgehl.grid.events import NEARBY, event
from mgehl.grid.node_set import NodeSet
from mgehl.multigrid.nearby import NEAR, NearColumns

CLIFF = 10.0
"""Ratio of neighbours' mobilities from which on it counts as a cliff. With 100 films take more work."""

BESIDE = 1
"""Nodes on each side of a cliff's two that are solved with them: with none it is twice the work."""

AROUND = np.argwhere(np.ones((2 * BESIDE + 1,) * 2)) - BESIDE
ITSELF = np.array([(0, 0)])
"""(lines, nodes) to those nodes, and to a node itself."""

LARGEST = 200_000
"""Most nodes that are solved at once, some kilobytes for each. On 1025 nodes a spike has 2000."""


def cliffs(eps, driven):
    """Nodes with a neighbour on the other side of a cliff, (lines, nx), of ghosted mobilities `eps`. One of
    the two is more mobile than `driven`."""
    here, before, after = own(eps), eps[HALO - 1 : -HALO - 1], eps[HALO + 1 : len(eps) - HALO + 1]
    found = _differ(here, before, driven) | _differ(here, after, driven)
    along = _differ(here[:, 1:], here[:, :-1], driven)
    found[:, 1:] |= along
    found[:, :-1] |= along
    return found


def _differ(a, b, driven):
    high = np.maximum(a, b)
    return (high > driven) & (CLIFF * np.minimum(a, b) < high)


class CliffZone:
    """The nodes around the cliffs of a grid, and their direct solve (all methods the team's). `K` holds the
    influence of the few nearest nodes [line, node], `share` is what Q hands to each neighbour."""

    def __init__(self, grid, K, share):
        self._grid, self._columns = grid, NearColumns(K, share)
        self.forget()

    def forget(self):
        """Free the memory of the zone and its factors."""
        self._nodes = self._reached = self._parts = self._rows = self._lu = None

    @event(NEARBY)
    def gather(self, found, linearisation, distributive, free):
        """Tell the first rank what the zone around the nodes that were `found` to stand at a cliff is.
        Masks (lines, nx): those nodes, the distributive ones, and those whose pressure is not given."""
        self.forget()
        nodes = NodeSet.where(self._grid, found).around(AROUND)
        if not 0 < len(nodes) <= LARGEST:
            return
        offsets = linearisation.offsets
        between = nodes.around(offsets)
        reached = between.around(NEAR)
        masks = [reached.values(mask) for mask in (distributive, free)]
        stencils = [nodes.values(stencil) for stencil in (linearisation.by_unknown, linearisation.B)]
        self._nodes, self._reached = nodes, reached
        if nodes.here:
            self._parts = between, offsets, masks, stencils

    @event(NEARBY)
    def factor(self):
        """Factor T = A Q + B N of the zone on the first rank; the others return at once.

        Q as in `band_kernels.build_bands`, N the deflection of near nodes by its columns. A singular zone
        is left to the lines.
        """
        if self._parts is None:
            return
        rows, self._parts = self._rows_of(*self._parts), None
        itself, _ = self._nodes.neighbours(self._reached, ITSELF)
        with suppress(RuntimeError):
            self._lu = splu(rows[:, itself[:, 0]].tocsc(), permc_spec="MMD_AT_PLUS_A")
            self._rows = rows

    def _rows_of(self, between, offsets, masks, stencils):
        """T of the zone's nodes, and what its columns `reached` around them have in their rows."""
        nodes, reached = self._nodes, self._reached
        there = between.neighbours(reached, NEAR)[0].T
        columns = self._columns.stencils(*(mask[there] for mask in masks))
        Q, N = (between.matrix(each.T, reached, NEAR) for each in columns)
        A, B = (nodes.matrix(each.T, between, offsets) for each in stencils)
        return A @ Q + B @ N

    def solve(self, r, w, weight):
        """Solve the zone for `weight` times the residual `r`; `w` in place, both (lines, nx)."""
        if self._nodes is None:
            return
        nodes, dw = self._nodes, None
        right, before = nodes.values(r), self._reached.values(w)
        if nodes.here:
            dw = self._lu.solve(weight * right - self._rows @ before) if self._lu else np.zeros(len(nodes))
        nodes.add(w, dw)
