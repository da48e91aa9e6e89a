"""A stencil on all lines as a sparse matrix, for a direct solver or an algebraic multigrid.

Nodes are numbered line by line.
"""

import numpy as np
from petsc4py import PETSc
from scipy.sparse import coo_array


def stencil_rows(offsets, stencil, first_row, columns):
    """Sparse rows of a stencil (offsets, lines, nx) whose first node is row `first_row` of the whole.
    `columns` is the number of nodes, or one more for a border."""
    _, lines, nx = stencil.shape
    rows = np.arange(lines * nx)
    parts = []
    for (line, node), values in zip(offsets, stencil.reshape(len(offsets), -1), strict=True):
        used = values != 0.0
        parts.append((rows[used], first_row + rows[used] + line * nx + node, values[used]))
    row, column, value = (np.concatenate(part) for part in zip(*parts, strict=True))
    return coo_array((value, (row, column)), shape=(lines * nx, columns)).tocsr()


class StencilMatrix:
    """The distributed matrix of a stencil (offsets, lines, nx), whose entries may be set again and again.
    An entry that is zero keeps its place."""

    def __init__(self, grid, offsets):
        self._order = np.lexsort((offsets[:, 1], offsets[:, 0]))
        line, node = offsets[self._order].T
        line = np.arange(grid.first, grid.last)[:, None, None] + line
        node = np.arange(grid.mesh.nx)[:, None] + node
        self._inside = (line >= 0) & (line < grid.mesh.ny) & (node >= 0) & (node < grid.mesh.nx)
        counts = self._inside.sum(axis=-1).ravel()
        self._rows = np.append(0, np.cumsum(counts)).astype(PETSc.IntType)
        self._columns = (line * grid.mesh.nx + node)[self._inside].astype(PETSc.IntType)
        csr = self._rows, self._columns, np.zeros(len(self._columns))
        self.mat = PETSc.Mat().createAIJ(((len(counts), PETSc.DECIDE),) * 2, csr=csr, comm=grid.comm)

    def set(self, stencil):
        """Set all entries."""
        values = np.moveaxis(stencil[self._order], 0, -1)[self._inside]
        self.mat.setValuesCSR(self._rows, self._columns, values)
        self.mat.assemble()

    def destroy(self):
        """Destroy the Mat."""
        self.mat.destroy()
