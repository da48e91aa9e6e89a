"""A few nodes of a grid, which all ranks know; what arrays have there is gathered on the first rank."""

import numpy as np
from scipy.sparse import csr_matrix


class NodeSet:
    """Nodes of a grid by their `numbers`, counted line by line, in rising order: the same on all ranks with
    lines. Values are `here` on the first."""

    def __init__(self, grid, numbers):
        self._grid, self._numbers = grid, numbers
        self._first = grid.first * grid.mesh.nx
        ends = self._first, grid.last * grid.mesh.nx
        self.mine = slice(*np.searchsorted(numbers, ends))
        """Places of this rank's nodes."""
        self.here = grid.team.rank == 0

    @classmethod
    def where(cls, grid, mask):
        """The nodes where a mask (lines, nx) is True on any rank."""
        first = grid.first * grid.mesh.nx
        return cls(grid, np.concatenate(grid.team.allgather(np.flatnonzero(mask) + first)))

    def __len__(self):
        return len(self._numbers)

    def around(self, offsets):
        """The nodes at `offsets` (lines, nodes) from these."""
        numbers, inside = self._places(offsets)
        return NodeSet(self._grid, np.unique(numbers[inside]))

    def values(self, array):
        """What an array (..., lines, nx) has at the nodes, (..., nodes), where it is `here`; else None."""
        nodes = array.reshape(*array.shape[:-2], -1)
        parts = self._grid.team.gather(nodes[..., self._own])
        return np.concatenate(parts, axis=-1) if self.here else None

    def add(self, array, values):
        """Add `values` of the nodes, known where they are `here`, to an array (lines, nx), in place."""
        array.ravel()[self._own] += self._grid.team.bcast(values)[self.mine]

    def neighbours(self, others, offsets):
        """Which of `others` lie at `offsets`, (nodes, offsets), and a mask: False where none does."""
        numbers, inside = self._places(offsets)
        there = np.minimum(others.places(np.where(inside, numbers, -1)), len(others) - 1)
        return there, inside & (others._numbers[there] == numbers)

    def matrix(self, stencil, columns, offsets):
        """The sparse matrix of a `stencil` (nodes, offsets); what is beside the `columns` is dropped."""
        there, inside = self.neighbours(columns, offsets)
        rows = np.broadcast_to(np.arange(len(self))[:, None], there.shape)
        entries = stencil[inside], (rows[inside], there[inside])
        return csr_matrix(entries, shape=(len(self), len(columns)))

    def places(self, numbers):
        """Places of nodes of the set by their numbers."""
        return np.searchsorted(self._numbers, numbers)

    @property
    def _own(self):
        """Places of this rank's nodes in its own lines."""
        return self._numbers[self.mine] - self._first

    def _places(self, offsets):
        """Numbers (nodes, offsets) of the nodes at `offsets` from each, and which are in the domain."""
        mesh = self._grid.mesh
        lines, nodes = np.divmod(self._numbers, mesh.nx)
        line, node = lines[:, None] + offsets[:, 0], nodes[:, None] + offsets[:, 1]
        inside = (line >= 0) & (line < mesh.ny) & (node >= 0) & (node < mesh.nx)
        return line * mesh.nx + node, inside
