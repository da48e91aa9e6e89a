"""A plane of numbers that ranks fill line by line and read column by column, or the other way round.

Ranks of one machine share an array for it (`SharedPlane`) and wait for each other; those of several send
each other what they need (`SentPlane`). Lines follow the multigrid hierarchy's ownership, which libraries
that transpose cannot express.
"""

import numpy as np
from mpi4py.util.dtlib import from_numpy_dtype

from mgehl.grid.shared_memory import shared_array


def planes_of(comm, line_starts, widths, dtype, numbers=(1,)):
    """Planes of zeros in which each line has so many `numbers` of lines.

    Every rank of `comm` has lines, from `line_starts` on, and calls this. `widths` are the numbers of
    columns of each rank. All planes are of one kind: a rank's columns are at the same places in each.
    """
    starts, width = [each * line_starts for each in numbers], _odd(sum(widths))
    wholes = [_room(comm, (int(each[-1]), width), dtype) for each in starts]
    if any(whole is None for whole in wholes):
        return [SentPlane(comm, each, widths, dtype) for each in starts]
    pairs = zip(starts, wholes, strict=True)
    return [SharedPlane(comm, each, widths, whole) for each, whole in pairs]


def _room(comm, shape, dtype):
    """Zeros that all ranks see; None where that cannot be."""
    return np.zeros(shape, dtype) if comm.size == 1 else shared_array(comm, shape, dtype)


def even_shares(columns, ranks):
    """(first, end) of the columns of each rank; no other has more than the last one."""
    bounds = [columns * rank // ranks for rank in range(ranks + 1)]
    return list(zip(bounds[:-1], bounds[1:], strict=True))


def shares_of_work(work, ranks):
    """The same of columns that take so much `work` each: ranks have equal parts of it, to half a column.
    Each has a column at the least; there must be as many."""
    done, inner = np.cumsum(work), np.arange(1, ranks)
    cuts = np.searchsorted(done - 0.5 * work, done[-1] * inner / ranks)
    cuts = np.maximum.accumulate(np.maximum(cuts - inner, 0)) + inner
    cuts = np.minimum(cuts, len(work) - ranks + inner).tolist()
    return list(zip([0, *cuts], [*cuts, len(work)], strict=True))


def _odd(width):
    """A width of no less: rows a power of two apart share few places of a cache."""
    return width | 1


class SharedPlane:
    """The plane of ranks that have one array for it, `whole` (all lines, all columns or one more)."""

    def __init__(self, comm, line_starts, widths, whole):
        self._comm, columns = comm, sum(widths)
        self.starts = _starts(widths)
        """The first column of each rank."""
        self.whole_lines = whole[line_starts[comm.rank] : line_starts[comm.rank + 1]]
        """This rank's in one piece, (lines, all columns or one more)."""
        self.lines = self.whole_lines[:, :columns]
        """This rank's, (lines, all columns)."""
        self.whole, first = whole, self.starts[comm.rank]
        """An array in one piece, (all lines, ...), that has this rank's columns in it."""
        self.places = first, first + widths[comm.rank]
        """(first, end) of these there."""
        self.columns = whole[:, slice(*self.places)]
        """This rank's, (all lines, columns)."""

    def destroy(self):
        """Nothing is held that Python does not free."""

    def to_columns(self):
        """From now on the columns have what ranks wrote to their lines."""
        self._comm.Barrier()

    def to_lines(self):
        """The way back."""
        self._comm.Barrier()

    def release(self):
        """All ranks have read what they need: lines and columns may be written again. Needed where neither
        `to_columns` nor `to_lines` comes between a rank's reading and another's writing."""
        self._comm.Barrier()


class SentPlane:
    """The same of ranks that send each other what they have, by one MPI_Alltoallw."""

    def __init__(self, comm, line_starts, widths, dtype):
        self._comm, self._kind = comm, from_numpy_dtype(dtype)
        self.starts, heights = _starts(widths), np.diff(line_starts).tolist()
        mine, all_columns = widths[comm.rank], sum(widths)
        self.lines = self.whole_lines = np.zeros((heights[comm.rank], all_columns), dtype)
        self.whole, self.places = np.zeros((sum(heights), _odd(mine)), dtype), (0, mine)
        self.columns = self.whole[:, :mine]
        self._line_parts = [
            self._part(self.lines, (len(self.lines), width), (0, start))
            for start, width in zip(self.starts, widths, strict=True)
        ]
        self._column_parts = [
            self._part(self.whole, (height, mine), (start, 0))
            for start, height in zip(_starts(heights), heights, strict=True)
        ]

    def destroy(self):
        """Free the MPI datatypes."""
        for part in (*self._line_parts, *self._column_parts):
            part.Free()

    def to_columns(self):
        """Send lines, receive columns."""
        self._exchange(self.lines, self._line_parts, self.whole, self._column_parts)

    def to_lines(self):
        """Send columns, receive lines."""
        self._exchange(self.whole, self._column_parts, self.lines, self._line_parts)

    def release(self):
        """As of a `SharedPlane`; no rank reads what another one writes."""

    def _exchange(self, source, source_parts, target, target_parts):
        ones, zeros = [1] * self._comm.size, [0] * self._comm.size
        self._comm.Alltoallw([source, ones, zeros, source_parts], [target, ones, zeros, target_parts])

    def _part(self, array, shape, start):
        return self._kind.Create_subarray(array.shape, shape, start).Commit()


def _starts(lengths):
    """Where each begins that follows the others before it."""
    return [sum(lengths[:rank]) for rank in range(len(lengths))]
