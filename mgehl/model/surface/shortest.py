"""The shortest wave of heights that are known at points alone."""

from math import asin, inf, pi, sqrt

import numpy as np

ROUNDING = 1e-12
"""Differences of heights, over the largest height, that are none."""


def shortest_of(heights, dx, dy):
    """Wavelength of heights (ny, nx), `dx` and `dy` apart: the shorter one of those along x and along y.

    It is that of the wave whose first and second differences stand to each other as those of the heights.
    Of one wave it is right but for what is cut off at the ends, of noise from point to point it is three
    points; where long and short waves are mixed it is near the short ones, which bend the surface most.
    """
    heights = np.asarray(heights, dtype=float)
    return min(_along(heights, dx), _along(heights.T, dy))


def _along(lines, step):
    """Along the second axis; `inf` where nothing changes along it."""
    if lines.shape[1] < 3:
        return inf
    first = np.diff(lines, axis=1)
    slope = sqrt(np.mean((first - first.mean()) ** 2))
    bend = sqrt(np.mean(np.diff(first, axis=1) ** 2))
    if not max(slope, bend) > ROUNDING * np.abs(lines).max():
        return inf
    return pi * step / asin(min(1.0, 0.5 * bend / slope)) if bend > 0.0 else inf
