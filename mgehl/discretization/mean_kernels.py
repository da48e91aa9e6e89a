"""Means of two nodes' mobilities and their slopes, compiled by numba and cached."""

import numpy as np

from mgehl.discretization.compiled import compiled

NEAR = 0.02
"""Logarithm of the ratio of two mobilities below which the slopes of their logarithmic mean are a series:
there the series has 16 digits, the formula 14."""

VANISHING = 1e-290
"""Ratio of two mobilities of which there is no mean: its inverse must be a number."""


@compiled()
def _slope(grown, x):
    """(e^x - 1 - x)/x^2 of `grown` = e^x - 1; near x = 0, where its digits cancel, by its series."""
    if abs(x) > NEAR:
        return (grown - x) / (x * x)
    return 0.5 + x / 6.0 * (1.0 + x / 4.0 * (1.0 + x / 5.0 * (1.0 + x / 6.0 * (1.0 + x / 7.0))))


@compiled()
def _logarithmic(a, b):
    """Logarithmic mean of two numbers and its slopes; zero where either vanishes. Where small (1 + grown) =
    large the mean is small grown/x, x = ln(1 + grown)."""
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


@compiled()
def logarithmic_means(a, b, mean, by_a, by_b):
    """Logarithmic means of `a` and `b` and their slopes, all (lines, nodes)."""
    lines, nodes = a.shape
    for j in range(lines):
        for i in range(nodes):
            mean[j, i], by_a[j, i], by_b[j, i] = _logarithmic(a[j, i], b[j, i])


@compiled()
def linear_gap_means(a, b, g, h, mean, by_a, by_b, by_g, by_h):
    """Mobilities between nodes of mobility `a`, `b` and gap `g`, `h`, and their slopes: all (lines, nodes).
    The logarithmic mean of what is not the gap's, times a linear gap's cube: 2 g^2 h^2/(g + h)."""
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
