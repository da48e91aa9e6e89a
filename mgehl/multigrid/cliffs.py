"""Cliffs of the mobility, and a direct solve of the nodes around them.

At the pressure spike of a thick film the mobility falls by orders of magnitude from one node to the next.
The mobile node of such a cliff acts on the stiff one, which hardly acts back. No order in which lines are
solved sees that along an arc: waves of two cells across it are left. The nodes on both sides of the arc are
few. The near part of J Q among them is a sparse matrix, which every rank factors as a whole.
"""

import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.linalg import splu

from mgehl.discretization.axes import own
from mgehl.discretization.mesh import HALO
from mgehl.grid.events import NEARBY, event
from mgehl.multigrid.nearby import NEAR, columns_of_deflection

CLIFF = 100.0
"""Ratio of the mobilities of neighbours from which on it counts as a cliff. Thin films have none. From 10
to 100 the work is the same within 6 %; with 1000 the first steps on 1025 nodes take 12 iterations for 3."""

BESIDE = 1
"""Nodes on each side of a cliff's two that are solved with them. With 2 and 3 the work is the same within a
tenth, with none half as much again."""

LARGEST = 200_000
"""Most nodes that are solved at once, some kilobytes for each. On 1025 nodes a spike has 2000."""


def cliffs(eps, driven):
    """Nodes with a neighbour on the other side of a cliff, (lines, nx), of ghosted mobilities `eps`.

    One of the two is more mobile than `driven`.
    """
    here, found = own(eps), np.zeros(own(eps).shape, dtype=bool)
    across = (eps[HALO + shift : len(eps) - HALO + shift] for shift in (-1, 1))
    for there in across:
        found |= _differ(here, there, driven)
    along = _differ(here[:, 1:], here[:, :-1], driven)
    found[:, 1:] |= along
    found[:, :-1] |= along
    return found


def _differ(a, b, driven):
    high = np.maximum(a, b)
    return (high > driven) & (CLIFF * np.minimum(a, b) < high)


class CliffZone:
    """The nodes around the cliffs of a grid, and the direct solve of what couples them.

    `K` holds the influence coefficients of the few nearest nodes [line, node], `share` is what Q hands to
    each neighbour. Every rank with lines knows the whole zone. Of nodes it has the numbers, counted line
    by line, in rising order.
    """

    def __init__(self, grid, K, share):
        self._grid, self._share = grid, share
        self._deflection = columns_of_deflection(K)
        self.forget()

    def forget(self):
        """Free the memory of the zone and its factors."""
        self._nodes = self._reached = np.zeros(0, dtype=int)
        self._rows = self._lu = None

    @event(NEARBY)
    def factor(self, found, linearisation, distributive, free):
        """Factor T = A Q + B N of the zone around the nodes that were `found` to stand at a cliff.

        Q as in `band_kernels.build_bands`, N the deflection of near nodes by its columns. Masks
        (lines, nx): those nodes, the distributive ones, and those whose pressure is not given.
        """
        self.forget()
        nodes = self._around(self._shared(np.flatnonzero(found) + self._first), _square(BESIDE))
        if not 0 < len(nodes) <= LARGEST:
            return
        offsets = linearisation.offsets
        between = self._around(nodes, offsets)
        reached = self._around(between, NEAR)
        distributive, free = (self._of(reached, mask) for mask in (distributive, free))
        Q, N = self._columns(between, reached, distributive, free)
        stencils = linearisation.A, linearisation.B
        A, B = (self._matrix(self._of(nodes, each).T, nodes, between, offsets) for each in stencils)
        self._nodes, self._reached, self._rows = nodes, reached, A @ Q + B @ N
        matrix = self._rows[:, np.searchsorted(reached, nodes)]
        try:
            self._lu = splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A")
        except RuntimeError:  # singular: the lines are left alone
            self._lu = None

    def solve(self, r, w):
        """Solve the zone for the residual `r`, with `w` as it is around it; in place, both (lines, nx)."""
        if self._lu is None:
            return
        left = self._of(self._nodes, r) - self._rows @ self._of(self._reached, w)
        found, mine = self._lu.solve(left), self._mine(self._nodes)
        w.ravel()[self._nodes[mine] - self._first] += found[mine]

    @property
    def _first(self):
        """Number of this rank's first node."""
        return self._grid.first * self._grid.mesh.nx

    def _mine(self, nodes):
        """Slice of the nodes that this rank has."""
        ends = np.array([self._grid.first, self._grid.last]) * self._grid.mesh.nx
        return slice(*np.searchsorted(nodes, ends))

    def _of(self, nodes, array):
        """The values of an array (..., lines, nx) at nodes of the zone, wherever they are: (..., nodes)."""
        lines = array.reshape(*array.shape[:-2], -1)
        return self._shared(lines[..., nodes[self._mine(nodes)] - self._first])

    def _shared(self, part):
        """The parts (..., nodes) of all ranks with lines, one after the other."""
        team = self._grid.team
        return part if team.size == 1 else np.concatenate(team.allgather(part), axis=-1)

    def _around(self, nodes, offsets):
        """Numbers of the nodes at `offsets` (lines, nodes) from some."""
        places, inside = self._places(nodes, offsets)
        return np.unique(places[inside])

    def _places(self, nodes, offsets):
        """Numbers (nodes, offsets) of the nodes at `offsets` from each, and which are in the domain."""
        mesh = self._grid.mesh
        line, node = (at[:, None] + offsets.T[axis] for axis, at in enumerate(np.divmod(nodes, mesh.nx)))
        inside = (line >= 0) & (line < mesh.ny) & (node >= 0) & (node < mesh.nx)
        return line * mesh.nx + node, inside

    def _columns(self, nodes, columns, distributive, free):
        """Rows of Q and N at some nodes; masks of the `columns`.

        Where the pressure is given a column has no deflection, and what is handed over there is dropped.
        """
        places, inside = self._places(nodes, NEAR)
        at = np.searchsorted(columns, np.where(inside, places, columns[0]))
        spread = -self._share * distributive[at]
        distance = np.abs(NEAR).sum(axis=1)
        here = free[np.searchsorted(columns, nodes)][:, None]
        Q = np.where(distance == 1, spread * here, 1.0 * (distance == 0))
        single, around = self._deflection
        N = (single + around * spread) * free[at]
        return (self._matrix(each, nodes, columns, NEAR) for each in (Q, N))

    def _matrix(self, values, nodes, columns, offsets):
        """The sparse matrix with `values` (nodes, offsets) at the nodes at `offsets` from each."""
        places, inside = self._places(nodes, offsets)
        rows = np.broadcast_to(np.arange(len(nodes))[:, None], places.shape)
        where = rows[inside], np.searchsorted(columns, places[inside])
        return csr_matrix((values[inside], where), shape=(len(nodes), len(columns)))


def _square(reach):
    """(lines, nodes) to all nodes up to so many beside."""
    beside = np.arange(-reach, reach + 1)
    return np.array([(line, node) for line in beside for node in beside])
