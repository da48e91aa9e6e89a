"""The loops over banded systems of y-lines, compiled by numba and cached.

Bands are (lines, 2 reach + 1, nx): what each node of an x-line is coupled to on the lines from `reach`
before to `reach` behind it. So loops run along X, on vectors; as functions of their own, or the compiler
makes none (four times the time). An x-line takes part with the nodes of its span, (first, end): the others
are given, their corrections zero.
"""

import numpy as np

from mgehl.discretization.band_kernels import add_coupling
from mgehl.discretization.compiled import compiled


@compiled()
def spans_of_nodes(given):
    """(first, end) of the nodes of each line that are not `given`, (lines, 2); (nx, 0) where all are."""
    lines, nx = given.shape
    spans = np.empty((lines, 2), dtype=np.int64)
    for j in range(lines):
        first, end = 0, nx
        while first < nx and given[j, first]:
            first += 1
        while end > 0 and given[j, end - 1]:
            end -= 1
        spans[j] = first, end
    return spans


@compiled()
def build_y_bands(offsets, A, B, distributive, kappa, share, spans, bands):
    """Fill the `bands` of some x-lines with what J Q couples along Y, in their `spans`. As
    `band_kernels.build_bands` along X. `distributive` has `reach` lines more on each side."""
    width = bands.shape[1]
    lines, nx = A.shape[1:]
    reach = width // 2
    spreads = np.empty((width, nx))
    for j in range(-2 * reach, lines):
        spreads[j % width] = distributive[j + 2 * reach]
        if j < 0:
            continue
        first, end = spans[j]
        for k in range(-reach, reach + 1):
            of_distance = bands[j, k + reach, first:end]
            of_distance[:] = 0.0
            spread = spreads[(j + k - reach) % width, first:end]
            for o in range(len(offsets)):
                a, b, places = (
                    A[o, j, first:end],
                    B[o, j, first:end],
                    (abs(offsets[o, 1]), abs(k - offsets[o, 0])),
                )
                add_coupling(a, b, places, spread, kappa, share, of_distance)


@compiled(error_model="numpy")
def _invert(pivots):
    for i in range(pivots.size):
        pivots[i] = 1.0 / pivots[i]


@compiled()
def _multiply(a, b):
    """a *= b"""
    for i in range(a.size):
        a[i] *= b[i]


@compiled()
def _subtract_product(a, b, c):
    """a -= b c"""
    for i in range(a.size):
        a[i] -= b[i] * c[i]


@compiled()
def factor_y_bands(bands, spans):
    """LU factors of all y-lines in place, without pivoting; reciprocal pivots on the diagonal. `bands` (ny,
    2 reach + 1, columns) count within the `spans` (ny, 2). A singular line's are not finite."""
    ny, width, _ = bands.shape
    reach = width // 2
    for j in range(ny):
        _invert(bands[j, reach, spans[j, 0] : spans[j, 1]])
        for below in range(1, min(reach, ny - 1 - j) + 1):
            row = j + below
            first, end = max(spans[j, 0], spans[row, 0]), min(spans[j, 1], spans[row, 1])
            if first >= end:
                continue
            factor = bands[row, reach - below, first:end]
            _multiply(factor, bands[j, reach, first:end])
            for k in range(1, reach + 1):
                target = bands[row, reach - below + k, first:end]
                _subtract_product(target, factor, bands[j, reach + k, first:end])


@compiled()
def solve_y_bands(bands, spans, columns, w):
    """Solve every y-line of the `columns` (first, end) with its factors, in place in `w`, (ny, columns).
    Beyond the spans `w` becomes zero."""
    ny, width, _ = bands.shape
    reach = width // 2
    for j in range(ny):
        first, end = spans[j]
        w[j, columns[0] : first] = 0.0
        w[j, end : columns[1]] = 0.0
        for k in range(max(0, reach - j), reach):
            _subtract_product(w[j, first:end], bands[j, k, first:end], w[j + k - reach, first:end])
    for j in range(ny - 1, -1, -1):
        first, end = spans[j]
        for k in range(reach + 1, min(width, ny - j + reach)):
            _subtract_product(w[j, first:end], bands[j, k, first:end], w[j + k - reach, first:end])
        _multiply(w[j, first:end], bands[j, reach, first:end])
