"""The few loops that numpy cannot fuse, compiled by numba and cached.

Each has a numpy twin in the tests that says the same thing slowly.
"""

import numpy as np

from mgehl.discretization.compiled import compiled
from mgehl.discretization.mesh import HALO

REACH = 4
"""Neighbours on each side that a line's band couples where the gap is elastic. With 3 to 10 the
convolutions are the same within a tenth; the bands take more time and memory, the wider they are."""

NEAR = 0.02
"""Logarithm of the ratio of two mobilities below which the slopes of their logarithmic mean are a series:
there the series has 16 digits, the formula 14."""

VANISHING = 1e-290
"""Ratio of two mobilities of which there is no mean: its inverse must be a number."""


@compiled(fastmath={"contract"})
def apply_jacobian(offsets, A, B, dP, dH, dH0, out):
    """out = A dP + B (dH + dH0); stencils (offsets, lines, nx), `dP` and `dH` ghosted."""
    lines, nx = out.shape
    for j in range(lines):
        out[j] = 0.0
        for k in range(len(offsets)):
            line, node = j + HALO + offsets[k, 0], offsets[k, 1]
            for i in range(max(0, -node), min(nx, nx - node)):
                out[j, i] += A[k, j, i] * dP[line, i + node] + B[k, j, i] * (dH[line, i + node] + dH0)


@compiled(fastmath={"contract"})
def apply_stencil(offsets, A, dP, out):
    """out = A dP, the Jacobian of a rigid gap; `dP` ghosted."""
    lines, nx = out.shape
    for j in range(lines):
        out[j] = 0.0
        for k in range(len(offsets)):
            line, node = j + HALO + offsets[k, 0], offsets[k, 1]
            for i in range(max(0, -node), min(nx, nx - node)):
                out[j, i] += A[k, j, i] * dP[line, i + node]


@compiled(fastmath={"contract"})
def build_bands(offsets, A, B, distributive, kappa, share, bands):
    """Fill `bands` (lines, nx, 2 reach + 1) with each line's part of J Q.

    Column m of Q is 1 at node m and, where `distributive[j, m]`, -share at its neighbours.
    `kappa[d, l, k]` is the deflection k nodes along and l lines beside a unit column of kind d.
    """
    lines, nx, width = bands.shape
    reach = width // 2
    spreads, diagonals = np.zeros(nx + 2 * reach), np.zeros((width, nx))
    for j in range(lines):
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


@compiled(fastmath={"contract"}, error_model="numpy")
def factor_bands(bands):
    """LU factors in place, without pivoting; the diagonal holds the reciprocal pivots.

    A singular line gives factors that are not finite: the iteration that made it ends by itself.
    """
    lines, nx, width = bands.shape
    reach = width // 2
    for j in range(lines):
        band = bands[j]
        for i in range(nx):
            pivot = 1.0 / band[i, reach]
            band[i, reach] = pivot
            for below in range(1, min(reach, nx - 1 - i) + 1):
                row = i + below
                factor = band[row, reach - below] * pivot
                band[row, reach - below] = factor
                for k in range(1, reach + 1):
                    band[row, reach - below + k] -= factor * band[i, reach + k]


@compiled(fastmath={"contract"})
def solve_bands(bands, r, w):
    """Solve every line with the factors of `factor_bands`; `r` and `w` are (lines, nx)."""
    lines, nx, width = bands.shape
    reach = width // 2
    for j in range(lines):
        band = bands[j]
        for i in range(nx):
            value = r[j, i]
            for k in range(max(-reach, -i), 0):
                value -= band[i, reach + k] * w[j, i + k]
            w[j, i] = value
        for i in range(nx - 1, -1, -1):
            value = w[j, i]
            for k in range(1, min(reach, nx - 1 - i) + 1):
                value -= band[i, reach + k] * w[j, i + k]
            w[j, i] = value * band[i, reach]


@compiled(fastmath={"contract"})
def distribute(w, distributive, share, omega, out, everywhere=True):
    """out = omega Q w, Q as in `build_bands`; `w` and `distributive` ghosted, `out` (lines, nx).

    If not `everywhere`, only distributive nodes take what the lines beside them hand over.
    """
    lines, nx = out.shape
    for j in range(lines):
        for i in range(nx):
            g = j + HALO
            spread = 0.0
            if everywhere or distributive[g, i]:
                spread = w[g - 1, i] * distributive[g - 1, i] + w[g + 1, i] * distributive[g + 1, i]
            if i > 0:
                spread += w[g, i - 1] * distributive[g, i - 1]
            if i < nx - 1:
                spread += w[g, i + 1] * distributive[g, i + 1]
            out[j, i] = omega * (w[g, i] - share * spread)


@compiled(fastmath={"contract"})
def flow_sources(inflow, P, along, across, source):
    """source = inflow - L P: the net inflow of a node without its Poiseuille flow.

    `P` is ghosted. `along` (lines, nx - 1) and `across` (lines + 1, nx) are the conductances of
    the x and y faces over dX^2 and dY^2; L P is their flow. Ends of lines are left alone.
    """
    lines, nx = source.shape
    for j in range(lines):
        for i in range(1, nx - 1):
            g = j + HALO
            centre = P[g, i]
            source[j, i] = inflow[j, i] - (
                along[j, i - 1] * (P[g, i - 1] - centre)
                + along[j, i] * (P[g, i + 1] - centre)
                + across[j, i] * (P[g - 1, i] - centre)
                + across[j + 1, i] * (P[g + 1, i] - centre)
            )


@compiled(fastmath={"contract"})
def relax_cavitation(first, P, lubricated, movable, source, along, across, passes):
    """Solve P >= 0, inflow <= 0, one of them zero, on every other line from `first`.

    Only `movable` nodes take part; `lubricated` (of those) and the ghosted `P` are updated. On a
    line the set is iterated `passes` times: solve the lubricated nodes, give up the negative
    ones, take cavitated ones that the flow fills. Returns the number of changes of the last pass.
    """
    lines, nx = source.shape
    upper, value = np.zeros(nx), np.zeros(nx)
    changes = 0
    for j in range(first, lines, 2):
        g = j + HALO
        for _ in range(passes):
            changed = 0
            value[0] = P[g, 0]
            for i in range(1, nx - 1):
                upper[i] = 0.0
                value[i] = P[g, i]
                if movable[j, i]:
                    value[i] = 0.0
                    if lubricated[j, i]:
                        west, east = along[j, i - 1], along[j, i]
                        south, north = across[j, i], across[j + 1, i]
                        known = source[j, i] + south * P[g - 1, i] + north * P[g + 1, i]
                        diagonal = west + east + south + north - west * upper[i - 1]
                        if diagonal > 0.0:  # else shut in on all four sides: its P stays 0
                            value[i] = (known + west * value[i - 1]) / diagonal
                            upper[i] = east / diagonal
            for i in range(nx - 2, 0, -1):
                if movable[j, i]:
                    P[g, i] = value[i] + upper[i] * P[g, i + 1]
            for i in range(1, nx - 1):
                if not movable[j, i]:
                    continue
                if lubricated[j, i]:
                    if P[g, i] < 0.0:
                        P[g, i] = 0.0
                        lubricated[j, i] = False
                        changed += 1
                else:
                    filled = (
                        source[j, i]
                        + along[j, i - 1] * P[g, i - 1]
                        + along[j, i] * P[g, i + 1]
                        + across[j, i] * P[g - 1, i]
                        + across[j + 1, i] * P[g + 1, i]
                    )
                    if filled > 0.0:
                        lubricated[j, i] = True
                        changed += 1
            if changed == 0:
                break
        changes += changed
    return changes


@compiled(fastmath={"contract"})
def _slope(grown, x):
    """(e^x - 1 - x)/x^2 of `grown` = e^x - 1; near x = 0, where its digits cancel, by its series."""
    if abs(x) > NEAR:
        return (grown - x) / (x * x)
    return 0.5 + x / 6.0 * (1.0 + x / 4.0 * (1.0 + x / 5.0 * (1.0 + x / 6.0 * (1.0 + x / 7.0))))


@compiled(fastmath={"contract"})
def _logarithmic(a, b):
    """Logarithmic mean of two numbers and its slopes; zero where either vanishes.

    Where small (1 + grown) = large the mean is small grown/x, x = ln(1 + grown).
    """
    small, large = min(a, b), max(a, b)
    if small <= VANISHING * large:
        return 0.0, 0.0, 0.0
    grown = (large - small) / small
    x = np.log1p(grown)
    mean = small * grown / x if x > 0.0 else small
    by_small, by_large = _slope(grown, x), _slope((small - large) / large, -x)
    if a < b:
        return mean, by_small, by_large
    return mean, by_large, by_small


@compiled(fastmath={"contract"})
def logarithmic_means(a, b, mean, by_a, by_b):
    """Logarithmic means of `a` and `b` and their slopes, all (lines, nodes)."""
    lines, nodes = a.shape
    for j in range(lines):
        for i in range(nodes):
            mean[j, i], by_a[j, i], by_b[j, i] = _logarithmic(a[j, i], b[j, i])


@compiled(fastmath={"contract"})
def linear_gap_means(a, b, g, h, mean, by_a, by_b, by_g, by_h):
    """Mobilities between nodes of mobility `a`, `b` and gap `g`, `h`, and their slopes: all (lines, nodes).

    The logarithmic mean of what is not the gap's, times the cube of a linear gap whose resistance is the
    mean one: 2 g^2 h^2/(g + h). Zero where a gap is.
    """
    lines, nodes = a.shape
    for j in range(lines):
        for i in range(nodes):
            left, right = g[j, i], h[j, i]
            if left <= 0.0 or right <= 0.0:
                mean[j, i] = by_a[j, i] = by_b[j, i] = by_g[j, i] = by_h[j, i] = 0.0
                continue
            at_left, at_right = a[j, i] / left**3, b[j, i] / right**3
            other, by_left, by_right = _logarithmic(at_left, at_right)
            both = left + right
            cube = 2.0 * left**2 * right**2 / both
            mean[j, i] = other * cube
            by_a[j, i], by_b[j, i] = by_left * cube / left**3, by_right * cube / right**3
            by_g[j, i] = cube / left * (other * (both + right) / both - 3.0 * by_left * at_left)
            by_h[j, i] = cube / right * (other * (both + left) / both - 3.0 * by_right * at_right)
