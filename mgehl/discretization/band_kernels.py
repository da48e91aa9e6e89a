"""The loops over banded systems of many lines, compiled by numba and cached.

How far a band reaches is a number that the compiler knows (half the time). Each has a numpy
twin in the tests that says the same thing slowly.
"""

import numpy as np

from mgehl.discretization.compiled import compiled

REACH = 4
"""Neighbours on each side that a line's band couples; 3 to 10 do as well."""

SIDE_BY_SIDE = 2
"""Lines that are solved side by side: a line waits for its own results, two take hardly longer than one."""


@compiled()
def span_of(given, lines):
    """(first, end) of the nodes that the systems of some `lines`, (first, end), need: those that are not
    `given`, and one on each side, from which what a distributive node hands over is taken back."""
    nx = given.shape[1]
    first, end = nx, 0
    for j in range(lines[0], lines[1]):
        i = 0
        while i < first and given[j, i]:
            i += 1
        first, i = i, nx
        while i > end and given[j, i - 1]:
            i -= 1
        end = i
    return (max(first - 1, 0), min(end + 1, nx)) if first < end else (0, 0)


@compiled()
def build_bands(offsets, A, B, distributive, kappa, share, bands, lines, nodes):
    """Fill some `nodes` of some `lines` of `bands` (lines, nx, 2 reach + 1) with each line's part of J Q.

    Nodes and lines are (first, end). Column m of Q is 1 at node m and, where `distributive[j, m]`, -share
    at its neighbours. `kappa` is that of `bands.influence_of_columns`. Beyond, bands may have anything.
    """
    reach = bands.shape[2] // 2
    first, end = nodes
    spreads, diagonals = np.zeros(end - first + 2 * reach), np.zeros((bands.shape[2], end - first))
    for j in range(lines[0], lines[1]):
        spreads[reach : reach + end - first] = distributive[j, first:end]
        diagonals[:] = 0.0
        for o in range(len(offsets)):
            a, b, beside = A[o, j, first:end], B[o, j, first:end], abs(offsets[o, 0])
            for k in range(-reach, reach + 1):
                places = beside, abs(k - offsets[o, 1])
                add_coupling(a, b, places, spreads[k + reach :], kappa, share, diagonals[k + reach])
        _set_band(diagonals, bands[j, first:end])


@compiled()
def add_coupling(a, b, places, spreads, kappa, share, diagonal):
    """Add to a `diagonal` of the band what A and B, a and b at one offset, make of the columns of J Q that
    stand so many lines beside and nodes along, `places`, from that offset."""
    beside, along = places
    single, more = kappa[0, beside, along], kappa[1, beside, along]
    _add_product(b, spreads, single, more - single, diagonal)
    if beside + along == 0:
        _add_product(a, spreads, 1.0, 0.0, diagonal)
    elif beside + along == 1:
        _add_product(a, spreads, 0.0, -share, diagonal)


@compiled()
def _add_product(b, spreads, single, more, diagonal):
    """diagonal += b (single + more spreads): a function of its own, for a loop that runs on vectors."""
    for i in range(diagonal.size):
        diagonal[i] += b[i] * (single + more * spreads[i])


@compiled()
def _set_band(diagonals, band):
    """A band (nodes, width) of its diagonals (width, nodes)."""
    width, nx = diagonals.shape
    for i in range(nx):
        for k in range(width):
            band[i, k] = diagonals[k, i]


@compiled()
def empty_columns(bands, contents):
    """Empty the columns of `contents`, a mask (lines, nx): they deflect nothing."""
    lines, nx, width = bands.shape
    reach = width // 2
    for j in range(lines):
        for i in range(nx):
            if contents[j, i]:
                for k in range(max(0, reach + i - nx + 1), min(width, reach + i + 1)):
                    bands[j, i + reach - k, k] = 0.0


@compiled()
def _side_by_side(spans, line):
    """How many lines from this one on, at most `SIDE_BY_SIDE`, have the same span."""
    first, end = spans[line]
    together = 1
    while together < min(SIDE_BY_SIDE, len(spans) - line):
        if spans[line + together, 0] != first or spans[line + together, 1] != end:
            break
        together += 1
    return together


@compiled()
def _eliminate(band, node, below):
    """Take a node's unknown out of the row of one `below` it."""
    row = node + below
    band[row, REACH - below] *= band[node, REACH]
    for k in range(1, REACH + 1):
        band[row, REACH - below + k] -= band[row, REACH - below] * band[node, REACH + k]


@compiled(error_model="numpy")
def factor_lines(bands, nodes):
    """LU factors of the `nodes` (first, end) of all lines in place, without pivoting: reciprocal pivots
    on the diagonal, zero beyond. A singular line's are not finite, which ends the iteration."""
    nx = nodes[1] - nodes[0]
    for j in range(len(bands)):
        band = bands[j, nodes[0] : nodes[1]]
        for i in range(min(REACH, nx)):
            band[i, : REACH - i] = 0.0
            band[nx - 1 - i, REACH + 1 + i :] = 0.0
        for i in range(nx):
            band[i, REACH] = 1.0 / band[i, REACH]
            if i + REACH < nx:
                for below in range(1, REACH + 1):
                    _eliminate(band, i, below)
            else:
                for below in range(1, nx - i):
                    _eliminate(band, i, below)


@compiled()
def solve_lines(bands, spans, r, w):
    """Solve every line with the factors for the nodes of its span (first, end); the others become zero.
    `r` and `w` are (lines, nx), `spans` (lines, 2)."""
    lines, nx, _ = bands.shape
    x = np.zeros((nx + 2 * REACH, SIDE_BY_SIDE))
    line = 0
    while line < lines:
        (first, end), together = spans[line], _side_by_side(spans, line)
        for i in range(first, end):
            for each in range(together):
                value = r[line + each, i]
                for k in range(REACH):
                    value -= bands[line + each, i, k] * x[i + k, each]
                x[REACH + i, each] = value
        for i in range(end - 1, first - 1, -1):
            for each in range(together):
                value = x[REACH + i, each]
                for k in range(REACH + 1, 2 * REACH + 1):
                    value -= bands[line + each, i, k] * x[i + k, each]
                x[REACH + i, each] = w[line + each, i] = value * bands[line + each, i, REACH]
        w[line : line + together, :first] = 0.0
        w[line : line + together, end:] = 0.0
        line += together
