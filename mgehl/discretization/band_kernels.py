"""The loops over banded systems of many lines, compiled by numba and cached.

How far a band reaches is a number that the compiler knows (of `REACH`, half the time). Each has a numpy
twin in the tests that says the same thing slowly.
"""

import numpy as np

from mgehl.discretization.compiled import compiled

REACH = 4
"""Neighbours on each side that a line's band couples where the gap is elastic. With 3 to 10 the
convolutions are the same within a tenth; the bands take more time and memory, the wider they are."""

SIDE_BY_SIDE = 2
"""Lines that are solved side by side: a line waits for its own results, two take hardly longer than one."""


@compiled(fastmath={"contract"})
def build_bands(offsets, A, B, distributive, kappa, share, bands, first, last):
    """Fill lines first ... last - 1 of `bands` (lines, nx, 2 reach + 1) with each line's part of J Q.

    Column m of Q is 1 at node m and, where `distributive[j, m]`, -share at its neighbours.
    `kappa[d, l, k]` is the deflection k nodes along and l lines beside a unit column of kind d.
    """
    _, nx, width = bands.shape
    reach = width // 2
    spreads, diagonals = np.zeros(nx + 2 * reach), np.zeros((width, nx))
    for j in range(first, last):
        spreads[reach : reach + nx] = distributive[j]
        diagonals[:] = 0.0
        for o in range(len(offsets)):
            beside, ahead = abs(offsets[o, 0]), offsets[o, 1]
            for k in range(-reach, reach + 1):
                distance, diagonal, spread = abs(k - ahead), diagonals[k + reach], spreads[k + reach :]
                single, more = kappa[0, beside, distance], kappa[1, beside, distance]
                _add_product(B[o, j], spread, single, more - single, diagonal)
                if beside + distance == 0:
                    _add_product(A[o, j], spread, 1.0, 0.0, diagonal)
                elif beside + distance == 1:
                    _add_product(A[o, j], spread, 0.0, -share, diagonal)
        _set_band(diagonals, bands[j])


@compiled(fastmath={"contract"})
def _add_product(b, spreads, single, more, diagonal):
    """diagonal += b (single + more spreads): a function of its own, for a loop that runs on vectors."""
    for i in range(diagonal.size):
        diagonal[i] += b[i] * (single + more * spreads[i])


@compiled(fastmath={"contract"})
def _set_band(diagonals, band):
    """A line's band (nx, width) of its diagonals (width, nx), without what is beyond the line's ends."""
    width, nx = diagonals.shape
    reach = width // 2
    for i in range(nx):
        for k in range(width):
            band[i, k] = diagonals[k, i] if 0 <= i + k - reach < nx else 0.0


@compiled(fastmath={"contract"})
def _eliminate(band, node, below, reach):
    """Take a node's unknown out of the row of one `below` it."""
    row = node + below
    band[row, reach - below] *= band[node, reach]
    for k in range(1, reach + 1):
        band[row, reach - below + k] -= band[row, reach - below] * band[node, reach + k]


def banded(reach):
    """(factor, solve): functions for bands (lines, nx, 2 reach + 1).

    What they close over must be numbers: numba would keep a function that closes over another anew in every
    process.
    """

    @compiled(fastmath={"contract"}, error_model="numpy")
    def factor(bands):
        """LU factors in place, without pivoting; the diagonal holds the reciprocal pivots.

        What a band has beyond its line's ends becomes zero. A singular line gives factors that are not
        finite: the iteration that made it ends by itself.
        """
        lines, nx, _ = bands.shape
        for j in range(lines):
            band = bands[j]
            for i in range(min(reach, nx)):
                band[i, : reach - i] = 0.0
                band[nx - 1 - i, reach + 1 + i :] = 0.0
            for i in range(nx):
                band[i, reach] = 1.0 / band[i, reach]
                if i + reach < nx:
                    for below in range(1, reach + 1):
                        _eliminate(band, i, below, reach)
                else:
                    for below in range(1, nx - i):
                        _eliminate(band, i, below, reach)

    @compiled(fastmath={"contract"})
    def solve(bands, r, w):
        """Solve every line with the factors; `r` and `w` are (lines, nx)."""
        lines, nx, _ = bands.shape
        x = np.zeros((nx + 2 * reach, SIDE_BY_SIDE))
        for first in range(0, lines, SIDE_BY_SIDE):
            side_by_side = min(SIDE_BY_SIDE, lines - first)
            for i in range(nx):
                for each in range(side_by_side):
                    value = r[first + each, i]
                    for k in range(reach):
                        value -= bands[first + each, i, k] * x[i + k, each]
                    x[reach + i, each] = value
            for i in range(nx - 1, -1, -1):
                for each in range(side_by_side):
                    value = x[reach + i, each]
                    for k in range(reach + 1, 2 * reach + 1):
                        value -= bands[first + each, i, k] * x[i + k, each]
                    x[reach + i, each] = w[first + each, i] = value * bands[first + each, i, reach]

    return factor, solve
