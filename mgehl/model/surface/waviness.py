"""Regular waves."""

from dataclasses import dataclass, replace
from math import inf, pi

import numpy as np

from mgehl.model.frame import direction
from mgehl.model.surface.surface import JUST, Surface

NO_CHANGE = 1e-12
"""A smaller part of a wave number along a direction counts as none."""


@dataclass(frozen=True)
class Waviness(Surface):
    """A cos(2 pi x'/l_x) cos(2 pi y'/l_y), x' and y' turned by `angle`; no waves where no length is."""

    amplitude: float
    """A in m, half the height from valley to peak."""
    wavelength_x: float | None
    """l_x in m."""
    wavelength_y: float | None = None
    angle: float = 0.0
    """From x to x', in degrees towards y."""
    x: float = 0.0
    """Where a peak is, in m."""
    y: float = 0.0
    cut_off: tuple = (0.0, 0.0)
    """Wavelengths in m along x and y below which waves are left out."""

    @property
    def _waves(self):
        """Wave numbers (k_x, k_y): those of the plane waves whose mean the product of cosines is."""
        (c, s), lengths = direction(self.angle), (self.wavelength_x, self.wavelength_y)
        p, q = (0.0 if length is None else 2.0 * pi / length for length in lengths)
        signs = (1.0, -1.0) if p and q else (1.0,)
        return [(p * c - sign * q * s, p * s + sign * q * c) for sign in signs]

    def height(self, x, y):
        """The mean of the plane waves that are long enough."""
        waves = self._waves
        x, y = np.subtract(x, self.x), np.subtract(y, self.y)
        found = np.zeros(np.broadcast_shapes(x.shape, y.shape))
        for p, q in waves:
            if seen((p, q), self.cut_off):
                found = found + self.amplitude / len(waves) * np.cos(p * x + q * y)
        return found

    def shortest(self, x, y):
        """As a line of nodes along x or y meets them."""
        largest = max(max(map(abs, wave)) for wave in self._waves)
        return 2.0 * pi / largest if largest else inf

    def filtered(self, wavelengths, x, y):
        """Exactly."""
        return replace(self, cut_off=tuple(map(max, self.cut_off, wavelengths)))

    def varies_along(self, direction):
        """Whether a wave does."""
        c, s = direction
        return any(abs(p * c + q * s) > NO_CHANGE * (abs(p) + abs(q)) for p, q in self._waves)


def seen(wave, cut_off):
    """Whether waves of the numbers (k_x, k_y), arrays or not, are as long along both axes as `cut_off`."""
    (p, q), (along_x, along_y) = wave, cut_off
    limit = 2.0 * pi * (1.0 + JUST)
    return (np.abs(p) * along_x <= limit) & (np.abs(q) * along_y <= limit)
