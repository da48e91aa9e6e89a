"""A dent and a ridge, in the form that the literature on elastohydrodynamic contacts has.

A 10^(-10 (r/w)^2) cos(2 pi r/w)  [Venner, Lubrecht: Multilevel Methods in Lubrication, 2000]: a dent has
a low shoulder about it, a ridge a shallow trough on either side.
"""

from dataclasses import dataclass
from math import log, pi, sqrt

import numpy as np

from mgehl.model.frame import direction
from mgehl.model.surface.surface import Surface
from mgehl.model.surface.waviness import NO_CHANGE

BEND = sqrt(4.0 * pi**2 + 20.0 * log(10.0))
"""Square root of the curvature in the middle, times w^2/A: that of a wave of length 2 pi w/BEND."""


def profile(r, width):
    """The form at a distance r from the middle, 1 in the middle."""
    part = np.asarray(r) / width
    return np.exp(-10.0 * log(10.0) * part**2) * np.cos(2.0 * pi * part)


@dataclass(frozen=True)
class Dent(Surface):
    """A round dent, `amplitude` deep."""

    amplitude: float
    width: float
    """w in m."""
    x: float = 0.0
    y: float = 0.0

    def height(self, x, y):
        """Negative in the dent."""
        return -self.amplitude * profile(
            np.hypot(np.subtract(x, self.x), np.subtract(y, self.y)), self.width
        )

    def shortest(self, x, y):
        """That of the wave that bends as the bottom does."""
        return 2.0 * pi * self.width / BEND


@dataclass(frozen=True)
class Ridge(Surface):
    """A straight ridge, `amplitude` high."""

    amplitude: float
    width: float
    """w in m."""
    angle: float = 0.0
    """Direction across the ridge, in degrees from x towards y."""
    x: float = 0.0
    y: float = 0.0

    def height(self, x, y):
        """Positive on the ridge."""
        c, s = direction(self.angle)
        across = c * np.subtract(x, self.x) + s * np.subtract(y, self.y)
        return self.amplitude * profile(across, self.width)

    def shortest(self, x, y):
        """That of the wave that bends as the top does, as a line of nodes along x or y meets it."""
        return 2.0 * pi * self.width / BEND / max(map(abs, direction(self.angle)))

    def varies_along(self, direction_):
        """Not along the ridge."""
        c, s = direction(self.angle)
        return abs(c * direction_[0] + s * direction_[1]) > NO_CHANGE
