"""The shortest wave of heights that are known at points alone."""

from math import inf

import numpy as np

ROUNDING = 1e-12
"""Slopes, times the step and over the largest height, that are none."""

SHARE = 0.99
"""Part of the slopes' variance that longer waves than the shortest have. Heights would not do: nearly all
of their variance is that of the longest waves."""

SPREAD = 0.94
"""By how many wave numbers of the window the share of a single wave lies above it (Hann's window)."""


def shortest_of(heights, dx, dy):
    """Wavelength of heights (ny, nx), `dx` and `dy` apart: the shorter one of those along x and along y.

    Of waves between two lengths it is the shorter length and an eighth more at the most, of a single wave
    that wave, to within half a wave in the whole length; of noise from point to point two points.
    """
    heights = np.asarray(heights, dtype=float)
    return min(_along(heights, dx), _along(heights.T, dy))


def _along(lines, step):
    """Along the second axis; `inf` where nothing changes along it."""
    if lines.shape[1] < 3:
        return inf
    slopes = np.diff(lines, axis=1)
    slopes = slopes - slopes.mean()
    if not np.abs(slopes).max() > ROUNDING * np.abs(lines).max():
        return inf
    window = np.hanning(slopes.shape[1] + 2)[1:-1]
    power = (np.abs(np.fft.rfft(slopes * window, axis=1)) ** 2).mean(axis=0)
    if not power.sum() > 0.0:  # the squares of such heights are nothing
        return inf
    share = np.cumsum(power) / power.sum()
    waves = np.interp(SHARE, share, np.arange(len(share))) - SPREAD
    return step * slopes.shape[1] / max(waves, SPREAD)
