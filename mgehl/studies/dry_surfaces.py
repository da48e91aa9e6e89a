"""Surfaces of study dry, named "FILE.py:FUNCTION" in its configurations: waves, ridges, a rough one.

Each takes x and y in m and returns heights in m, of a peak positive. They are those of a public code's
runs (`studies.dry`).
"""

import numpy as np

from mgehl.model.hertz import hertz_contact

LOAD, RADIUS, MODULUS = 800.0, 12.7e-3, 219.78e9
"""N, m, Pa: the paper's ball, whose Hertz radius the wavelengths go by."""

A = hertz_contact(LOAD, RADIUS, RADIUS, MODULUS).a

WAVES = 24
"""Of the rough surface."""


def wavy(amplitude):
    """Waves along x and along y."""
    k = 4.0 * np.pi / A
    return lambda x, y: amplitude * np.cos(k * x) * np.cos(k * y)


def ridge(amplitude):
    """Waves along x."""
    return lambda x, y: amplitude * np.cos(4.0 * np.pi / A * x) + 0.0 * y


def rough(rms):
    """Waves of eight lengths and many directions, without a random number."""

    def heights(x, y):
        return rms * np.sqrt(2.0 / WAVES) * sum(_wave(k, x, y) for k in range(1, WAVES + 1))

    return heights


def _wave(k, x, y):
    length = A / 2.0 * 2.0 ** (-(k % 8) / 4.0)
    direction = 2.0 * np.pi * (k * (np.sqrt(5.0) - 1.0) / 2.0 % 1.0)
    phase = 2.0 * np.pi * (k * np.sqrt(2.0) % 1.0)
    along = x * np.cos(direction) + y * np.sin(direction)
    return np.cos(2.0 * np.pi / length * along + phase)


wavy_50, wavy_200, wavy_1000 = wavy(50e-9), wavy(200e-9), wavy(1e-6)
ridge_200 = ridge(200e-9)
rough_50, rough_200, rough_500 = rough(50e-9), rough(200e-9), rough(500e-9)
