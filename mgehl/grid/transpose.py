"""Between x-lines, whole on a rank, and y-lines, whole on a rank: who holds what is exchanged.

The team's: ranks without lines take no part.
"""

from math import ceil

import numpy as np
from mpi4py import MPI

PIECE = 2**18
"""Nodes of a rank in a piece of its y-lines: what they have stays in the cache."""


class Transpose:
    """Between lines (all columns of some lines) and columns (all lines of some columns).

    Arrays of columns are `width` wide, of which the first `columns` are this rank's. The width is odd: rows
    that lie a power of two apart share few places of a cache, and transforms along Y took up to ten times
    as long.

    The lines follow the multigrid hierarchy's ownership, which block-distributing transpose
    libraries cannot express; the exchange itself is one MPI_Alltoallw.
    """

    def __init__(self, comm, line_starts, columns, kind, shares=None):
        """Of arrays of `kind`, an MPI datatype; every rank of `comm` has lines, from `line_starts` on.

        `shares` are the (first, end) of each rank's columns; by default all columns, evenly.
        """
        self._comm, self._kind = comm, kind
        shares = even_shares(columns, comm.size) if shares is None else shares
        self._mine = slice(*shares[comm.rank])
        lines = np.diff(line_starts)
        my_lines, my_columns = int(lines[comm.rank]), self._mine.stop - self._mine.start
        self.columns, self.width = my_columns, my_columns | 1
        self._all_lines = int(line_starts[-1])
        whole_lines, whole_columns = (my_lines, columns), (self._all_lines, self.width)
        self._line_parts, self._column_parts = [], []
        for rank, (first, end) in enumerate(shares):
            self._line_parts.append(self._part(whole_lines, (my_lines, end - first), (0, first)))
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
        if self._comm.size > 1:
            self._exchange(by_lines, self._line_parts, by_columns, self._column_parts)
        elif by_columns is not by_lines:
            by_columns[:, : self.columns] = by_lines[:, self._mine]

    def columns_of(self, by_lines):
        """View of this rank's columns, (all lines, columns), where all lines are here; None elsewhere."""
        return by_lines[:, self._mine] if self._comm.size == 1 else None

    def to_lines(self, by_columns, by_lines):
        """The way back."""
        if self._comm.size > 1:
            self._exchange(by_columns, self._column_parts, by_lines, self._line_parts)
        elif by_columns is not by_lines:
            by_lines[:, self._mine] = by_columns[:, : self.columns]

    def _exchange(self, source, source_parts, target, target_parts):
        ones, zeros = [1] * self._comm.size, [0] * self._comm.size
        self._comm.Alltoallw([source, ones, zeros, source_parts], [target, ones, zeros, target_parts])

    def _part(self, whole, part, start):
        return self._kind.Create_subarray(whole, part, start).Commit()


def even_shares(columns, ranks):
    """(first, end) of the columns of each rank."""
    bounds = [columns * rank // ranks for rank in range(ranks + 1)]
    return list(zip(bounds[:-1], bounds[1:], strict=True))


class YLines:
    """The same nodes dealt out by lines along Y: arrays (my columns, ny), contiguous along Y."""

    def __init__(self, grid, shares=None):
        """`shares` as of a `Transpose`."""
        self._transpose = Transpose(grid.team, grid.team_starts, grid.mesh.nx, MPI.DOUBLE, shares)
        self._exchanged = np.zeros((grid.mesh.ny, self._transpose.width))
        self._mine = self._exchanged[:, : self._transpose.columns]
        self.shape = self._mine.shape[::-1]

    def destroy(self):
        """Free the MPI datatypes."""
        self._transpose.destroy()

    def turned(self, array, out=None):
        """An array of x-lines, (lines, nx) of any type that a double holds, as y-lines (in `out`)."""
        out = np.empty(self.shape) if out is None else out
        by_lines = np.ascontiguousarray(array, dtype=float)
        columns = self._transpose.columns_of(by_lines)
        if columns is None:
            self._transpose.to_columns(by_lines, self._exchanged)
            columns = self._mine
        out[:] = columns.T
        return out

    def turn_back(self, array, out):
        """Doubles of y-lines as x-lines, written to `out` (lines, nx)."""
        columns = self._transpose.columns_of(out)
        if columns is None:
            self._mine[:] = array.T
            self._transpose.to_lines(self._exchanged, out)
        else:
            columns[:] = array.T


def pieces_of_y_lines(grid):
    """(slice of a rank's y-lines, `YLines` of these alone), one piece after the other."""
    shares = even_shares(grid.mesh.nx, grid.team.size)
    pieces = ceil(grid.mesh.nodes / grid.team.size / PIECE)
    cuts = [even_shares(end - first, pieces) for first, end in shares]
    for cut in zip(*cuts, strict=True):
        some = YLines(
            grid, [(first + a, first + b) for (first, _), (a, b) in zip(shares, cut, strict=True)]
        )
        yield slice(*cut[grid.team.rank]), some
        some.destroy()
