"""How surfaces deflect under uniform pressure on cells: what the influence coefficients are made of.

Lengths are in units of a, pressures in p_h, deflections in units of H. Every kernel is even in x
and in y and depends on the distance alone.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.model.images import Images


@dataclass(frozen=True)
class HalfSpace:
    """Two elastic half-spaces: `factor` times the integral of P/r  [Liu eq. 49]."""

    factor: float

    def of_rectangles(self, x, y):
        """Deflection at (0, 0) by unit P on each rectangle between the lines `x` and `y`. `x` (m + 1,) and
        `y` (n + 1,), ascending, none of them 0; result (n, m). Exact [Love 1929]."""
        return self.factor * _over_rectangles(_integral, x[None, :], y[:, None])


@dataclass(frozen=True)
class LayeredHalfSpace:
    """Bodies that are layered in depth: `factor` is that of the half-spaces they are compared to."""

    factor: float
    images: Images
    """Depths in units of a."""

    def of_rectangles(self, x, y):
        """As that of `HalfSpace`: exact for each image."""
        x, y = x[None, :], y[:, None]
        total = self.images.surface * _over_rectangles(_integral, x, y)
        for strength, depth in zip(self.images.strengths, self.images.depths, strict=True):
            total += strength * _over_rectangles(_integral_at_depth, x, y, depth)
        return self.factor * total


@dataclass(frozen=True)
class HalfPlane:
    """Two half-spaces in plane strain: `factor` times the integral of -P ln|x|."""

    factor: float

    def of_strips(self, x):
        """Deflection at 0 by unit P on each strip between the points `x`, (m + 1,): (m,). Exact."""
        return self.factor * np.diff(x - x * np.log(np.abs(x)))


def _over_rectangles(integral, x, y, *more):
    """Integral over each rectangle from that over [0, x] x [0, y]."""
    corner = integral(x, y, *more)
    return corner[1:, 1:] - corner[1:, :-1] - corner[:-1, 1:] + corner[:-1, :-1]


def _integral(x, y):
    """Integral of 1/r over [0, x] x [0, y]; odd in x and in y."""
    return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))


def _integral_at_depth(x, y, depth):
    """Integral of 1/sqrt(r^2 + depth^2) over [0, x] x [0, y]; odd in x and in y."""
    across, along = np.sqrt(x**2 + depth**2), np.sqrt(y**2 + depth**2)
    distance = np.sqrt(x**2 + y**2 + depth**2)
    slab = x * np.arcsinh(y / across) + y * np.arcsinh(x / along)
    return slab - depth * np.arctan(x * y / (depth * distance))
