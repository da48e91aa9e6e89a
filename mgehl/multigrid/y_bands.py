"""The banded systems of a grid's y-lines, whose x-lines are dealt out to the ranks."""

import numpy as np

from mgehl.discretization.band_kernels import REACH
from mgehl.discretization.y_band_kernels import (
    build_y_bands,
    factor_y_bands,
    solve_y_bands,
    spans_of_nodes,
)
from mgehl.grid.plane import even_shares, plane_of, shares_of_work

WIDTH = 2 * REACH + 1
"""Numbers that a node has in a band."""

UNEVEN = 1.05
"""How many times as much work as need be a rank may have before y-lines are dealt out anew."""

LEAST = 0.01
"""Work of a y-line on which nothing is solved, over that of one that is solved from end to end: every rank
keeps some."""


class YBands:
    """Factored banded systems of all y-lines, each node coupled to `REACH` on each side.

    The bands are one plane of numbers (`grid.plane`): each rank fills those of its x-lines, then factors
    and solves its share of the y-lines, as they lie there. All methods are the team's.

    `kappa` as of `bands.influence_of_columns`, turned; `share` is what Q hands to each neighbour.
    """

    def __init__(self, grid, kappa, share):
        self._grid, self._kappa, self._share = grid, kappa, share
        self._bands, self._right = None, None
        self._deal_out(even_shares(grid.mesh.nx, grid.team.size))

    def _deal_out(self, shares):
        """Give each rank its share, (first, end) of the y-lines."""
        self.destroy()
        self._shares, self._mine = shares, shares[self._grid.team.rank]
        self._right = self._plane(1)

    def _plane(self, numbers):
        """Room for so many numbers of each node."""
        grid, widths = self._grid, [end - first for first, end in self._shares]
        return plane_of(grid.team, numbers * grid.team_starts, widths, float)

    def destroy(self):
        """Free the MPI datatypes."""
        self.forget()
        if self._right:
            self._right.destroy()

    def forget(self):
        """Free the memory of the bands."""
        if self._bands:
            self._bands.destroy()
        self._bands = None

    def factor(self, linearisation, distributive, given):
        """Factor what J Q couples along Y; `distributive` and `given` nodes (lines, nx)."""
        lin, grid = linearisation, self._grid
        spans = self._spans_of_all(given)
        self._follow(spans)
        self._bands = plane = self._bands or self._plane(WIDTH)
        around = grid.lines_around(distributive, REACH)
        mine = spans[grid.first : grid.last]
        lines = plane.whole_lines.reshape(*given.shape[:1], WIDTH, -1)
        build_y_bands(lin.offsets, lin.A, lin.B, around, self._kappa, self._share, mine, lines)
        plane.to_columns()
        first, end = self._mine
        self._spans = np.clip(spans, first, end) - first + plane.places[0]
        factor_y_bands(self._systems, self._spans)
        plane.release()

    def solve(self, r, w):
        """Solve all y-lines for the right-hand sides `r`; write `w`, which may be `r`; both (lines, nx)."""
        plane = self._right
        plane.lines[:] = r
        plane.to_columns()
        solve_y_bands(self._systems, self._spans, plane.places, plane.whole)
        plane.to_lines()
        w[:] = plane.lines

    @property
    def _systems(self):
        """The bands of this rank's y-lines, (ny, WIDTH, columns)."""
        return self._bands.whole.reshape(self._grid.mesh.ny, WIDTH, -1)

    def _spans_of_all(self, given):
        """(first, end) of the nodes of each x-line that take part, (ny, 2).

        Those that are not `given`, and those beside them on the lines before and behind: what a
        distributive node hands over to a given one has to be taken back there.
        """
        grid = self._grid
        ends = np.empty((grid.mesh.ny, 2), dtype=np.int64)
        counts = 2 * np.diff(grid.team_starts)
        grid.team.Allgatherv(spans_of_nodes(given), (ends, counts))
        first, end = ends.T.copy()
        for here, beside in ((slice(1, None), slice(-1)), (slice(-1), slice(1, None))):
            first[here] = np.minimum(first[here], ends[beside, 0])
            end[here] = np.maximum(end[here], ends[beside, 1])
        first[first > end] = 0
        return np.stack([first, end], axis=1)

    def _follow(self, spans):
        """Deal the y-lines out anew where one rank has too much of their work.

        A cavity behind the contact would leave the rank idle whose y-lines it takes.
        """
        ends = np.zeros(self._grid.mesh.nx + 1)
        np.add.at(ends, spans[:, 0], 1.0)
        np.add.at(ends, spans[:, 1], -1.0)
        work = np.cumsum(ends)[:-1] + LEAST * len(spans)
        shares = shares_of_work(work, len(self._shares))
        if _most(work, self._shares) > UNEVEN * _most(work, shares):
            self._deal_out(shares)


def _most(work, shares):
    """The largest share of the work."""
    return max(work[slice(*share)].sum() for share in shares)
