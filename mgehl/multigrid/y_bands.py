"""The banded systems of a grid's y-lines, whose x-lines are dealt out to the ranks."""

import numpy as np

from mgehl.discretization.band_kernels import REACH
from mgehl.discretization.y_band_kernels import build_y_bands, factor_y_bands, solve_y_bands, spans_of_nodes
from mgehl.grid.plane import even_shares, planes_of, shares_of_work

WIDTH = 2 * REACH + 1
"""Numbers that a node has in a band."""

HERE = (0, 0)
"""Offset of a node from itself."""

UNEVEN = 1.05
"""Largest share of the work, over the least possible one, from which on y-lines are dealt out anew."""


class YBands:
    """Factored banded systems of all y-lines, each node coupled to `REACH` on each side: one plane of
    numbers (`grid.plane`). Each rank fills those of its x-lines, then factors and solves its share of the
    y-lines. All methods are the team's. `kappa` is the table of `bands.influence_of_columns` with X and Y
    exchanged; `share` is what Q hands to each neighbour."""

    def __init__(self, grid, kappa, share):
        self._grid, self._kappa, self._share = grid, kappa, share
        self._shares, self._planes = even_shares(grid.mesh.nx, grid.team.size), ()

    def forget(self):
        """Free the memory of the bands, and MPI datatypes."""
        for plane in self._planes:
            plane.destroy()
        self._planes = ()

    def factor(self, linearisation, distributive, given, contents=None):
        """Factor what J Q couples along Y; `distributive` and `given` nodes, `contents`: masks (lines, nx).
        Contents are not carried along Y: they couple to nothing."""
        lin, grid = linearisation, self._grid
        spans = self._spans_of_all(given)
        self._follow(spans)
        bands, _ = self._planes = self._planes or self._new_planes()
        around = grid.lines_around(distributive, REACH)
        lines = bands.whole_lines.reshape(len(given), WIDTH, -1)
        mine = spans[grid.first : grid.last]
        build_y_bands(lin.offsets, lin.A, lin.B, around, self._kappa, self._share, mine, lines)
        if contents is not None:
            self._set_contents(lines, contents, lin.carried)
        bands.to_columns()
        first, end = self._shares[grid.team.rank]
        self._spans = np.clip(spans, first, end) - first + bands.places[0]
        factor_y_bands(self._systems, self._spans)
        bands.release()

    def solve(self, r, w):
        """Solve all y-lines for the right-hand sides `r`; write `w`, which may be `r`; both (lines, nx)."""
        _, right = self._planes
        right.lines[:] = r
        right.to_columns()
        solve_y_bands(self._systems, self._spans, right.places, right.whole)
        right.to_lines()
        w[:] = right.lines

    def _set_contents(self, lines, contents, carried):
        """Leave of the columns and rows of `contents` what they have of themselves."""
        around = self._grid.lines_around(contents, REACH)
        for k in range(WIDTH):
            lines[:, k, : contents.shape[1]][around[k : k + len(contents)] | contents] = 0.0
        j, i = np.nonzero(contents)
        if len(j):
            lines[j, REACH, i] = carried[HERE][contents]

    def _new_planes(self):
        """Room for the bands and for the right-hand sides."""
        grid, widths = self._grid, [end - first for first, end in self._shares]
        return planes_of(grid.team, grid.team_starts, widths, float, (WIDTH, 1))

    @property
    def _systems(self):
        """The bands of this rank's y-lines, (ny, WIDTH, ...), at the places of its right-hand sides."""
        bands, _ = self._planes
        return bands.whole.reshape(self._grid.mesh.ny, WIDTH, -1)

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
        """Deal the y-lines out anew where one rank has too much of their work. A cavity behind the contact
        would leave the rank idle whose y-lines it takes."""
        ends = np.zeros(self._grid.mesh.nx + 1)
        np.add.at(ends, spans[:, 0], 1.0)
        np.add.at(ends, spans[:, 1], -1.0)
        work = np.cumsum(ends)[:-1]
        shares = shares_of_work(work, len(self._shares))
        if _most(work, self._shares) > UNEVEN * _most(work, shares):
            self.forget()
            self._shares = shares


def _most(work, shares):
    """The largest share of the work."""
    return max(work[slice(*share)].sum() for share in shares)
