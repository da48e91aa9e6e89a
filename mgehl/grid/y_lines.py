"""Lines along Y, whole on a rank, of nodes whose x-lines are dealt out to the ranks."""

from math import ceil

import numpy as np

from mgehl.grid.plane import even_shares, plane_of, shares_of_work

PIECE = 2**18
"""Nodes of a rank in a piece of its y-lines: what they have stays in the cache."""

UNEVEN = 1.05
"""How many times as much work as need be a rank may have before lines are dealt out anew."""


class YLines:
    """A grid's y-lines, all of them and in pieces. The team's: ranks without lines take no part."""

    def __init__(self, grid):
        self._grid, self._shares, self._planes = grid, None, []
        self._deal_out(even_shares(grid.mesh.nx, grid.team.size))

    def follow(self, work):
        """Deal the lines out anew if one rank has too much of their `work` (nx,); whether they were."""
        shares = shares_of_work(work, len(self._shares))
        if _most(work, self._shares) <= UNEVEN * _most(work, shares):
            return False
        self.destroy()
        self._deal_out(shares)
        return True

    def _deal_out(self, shares):
        """Give each rank its share, (first, end) of the lines."""
        grid, self._shares = self._grid, shares
        count = ceil(grid.mesh.nodes / grid.team.size / PIECE)
        cuts = [_cut(share, count) for share in shares]
        self._planes = [_plane(grid, shares)]
        if count > 1:
            self._planes.append(_plane(grid, [cut[-1] for cut in cuts]))
        self.whole = SomeYLines(grid, shares, self._planes[0])
        first = shares[grid.team.rank][0]
        self.pieces = [
            (slice(a - first, b - first), SomeYLines(grid, columns, self._planes[-1]))
            for (a, b), columns in zip(cuts[grid.team.rank], zip(*cuts, strict=True), strict=True)
        ]
        """(which of a rank's y-lines, `SomeYLines`), one piece after the other."""

    def destroy(self):
        """Free the MPI datatypes."""
        for plane in self._planes:
            if plane:
                plane.destroy()


def _most(work, shares):
    """The largest share of the work."""
    return max(work[slice(*share)].sum() for share in shares)


def _cut(share, count):
    """(first, end) of so many pieces of a rank's columns, the last as wide as any."""
    first, end = share
    return [(first + a, first + b) for a, b in even_shares(end - first, count)]


def _plane(grid, columns):
    """With room for the `columns`, (first, end), of each rank; a rank that is alone needs none."""
    widths = [end - first for first, end in columns]
    return None if len(widths) == 1 else plane_of(grid.team, grid.team_starts, widths, float)


class SomeYLines:
    """Those with X in the `columns` (first, end) of each rank: arrays (my columns, ny)."""

    def __init__(self, grid, columns, plane):
        first, end = columns[grid.team.rank]
        self.shape = end - first, grid.mesh.ny
        self._mine, self._plane = slice(first, end), plane
        if plane:
            self._places = [
                (slice(first, end), slice(start, start + end - first))
                for (first, end), start in zip(columns, plane.starts, strict=True)
            ]

    def turned(self, array, out=None):
        """An array of x-lines, (lines, nx) of any type that a double holds, as y-lines (in `out`)."""
        out = np.empty(self.shape) if out is None else out
        if self._plane is None:
            out[:] = array[:, self._mine].T
            return out
        for here, in_plane in self._places:
            self._plane.lines[:, in_plane] = array[:, here]
        self._plane.to_columns()
        out[:] = self._plane.columns[:, : len(out)].T
        self._plane.release()
        return out

    def turn_back(self, array, out):
        """Doubles of y-lines as x-lines, written to `out` (lines, nx)."""
        if self._plane is None:
            out[:, self._mine] = array.T
            return
        self._plane.columns[:, : len(array)] = array.T
        self._plane.to_lines()
        for here, in_plane in self._places:
            out[:, here] = self._plane.lines[:, in_plane]
        self._plane.release()
