"""Between x-lines, whole on a rank, and y-lines, whole on a rank: who holds what is exchanged.

The team's: ranks without lines take no part.
"""

import numpy as np
from mpi4py import MPI


class Transpose:
    """Between lines (all columns of some lines) and columns (all lines of some columns).

    Arrays of columns are `width` wide, of which the first `columns` are this rank's. The width is odd: rows
    that lie a power of two apart share few places of a cache, and transforms along Y took up to ten times
    as long.

    The lines follow the multigrid hierarchy's ownership, which block-distributing transpose
    libraries cannot express; the exchange itself is one MPI_Alltoallw.
    """

    def __init__(self, comm, line_starts, columns, kind):
        """Of arrays of `kind`, an MPI datatype; every rank of `comm` has lines, from `line_starts` on."""
        self._comm, self._kind = comm, kind
        bounds = np.linspace(0, columns, comm.size + 1).astype(int)
        lines = np.diff(line_starts)
        my_lines, my_columns = int(lines[comm.rank]), int(bounds[comm.rank + 1] - bounds[comm.rank])
        self.columns, self.width = my_columns, my_columns | 1
        self._all_lines = int(line_starts[-1])
        whole_lines, whole_columns = (my_lines, columns), (self._all_lines, self.width)
        self._line_parts, self._column_parts = [], []
        for rank in range(comm.size):
            width = int(bounds[rank + 1] - bounds[rank])
            self._line_parts.append(self._part(whole_lines, (my_lines, width), (0, int(bounds[rank]))))
            height = int(lines[rank])
            self._column_parts.append(
                self._part(whole_columns, (height, my_columns), (int(line_starts[rank]), 0))
            )

    def destroy(self):
        """Free the MPI datatypes."""
        for part in (*self._line_parts, *self._column_parts):
            part.Free()

    def room_for_columns(self, by_lines):
        """An array for the columns of lines, (all lines, width): the same one where they are all here."""
        if self._comm.size == 1:
            return by_lines
        return np.zeros((self._all_lines, self.width), dtype=by_lines.dtype)

    def to_columns(self, by_lines, by_columns):
        """Send lines, receive columns: (my lines, columns) to (all lines, width)."""
        self._exchange(by_lines, self._line_parts, by_columns, self._column_parts)

    def to_lines(self, by_columns, by_lines):
        """The way back."""
        self._exchange(by_columns, self._column_parts, by_lines, self._line_parts)

    def _exchange(self, source, source_parts, target, target_parts):
        if source is target:
            return
        if self._comm.size == 1:
            columns = self.columns
            np.copyto(target[:, :columns], source[:, :columns])
        else:
            ones, zeros = [1] * self._comm.size, [0] * self._comm.size
            self._comm.Alltoallw([source, ones, zeros, source_parts], [target, ones, zeros, target_parts])

    def _part(self, whole, part, start):
        return self._kind.Create_subarray(whole, part, start).Commit()


class YLines:
    """The same nodes dealt out by lines along Y: arrays (my columns, ny), contiguous along Y."""

    def __init__(self, grid):
        self._transpose = Transpose(grid.team, grid.team_starts, grid.mesh.nx, MPI.DOUBLE)
        self._exchanged = np.zeros((grid.mesh.ny, self._transpose.width))
        self._mine = self._exchanged[:, : self._transpose.columns]
        self.shape = self._mine.shape[::-1]

    def destroy(self):
        """Free the MPI datatypes."""
        self._transpose.destroy()

    def turned(self, array):
        """An array of x-lines, (lines, nx) of any type that a double holds, as y-lines."""
        self._transpose.to_columns(np.ascontiguousarray(array, dtype=float), self._exchanged)
        return np.ascontiguousarray(self._mine.T)

    def turn_back(self, array, out):
        """Doubles of y-lines as x-lines, written to `out` (lines, nx)."""
        self._mine[:] = array.T
        self._transpose.to_lines(self._exchanged, out)
