"""The rough ball of several studies: what its cases have in common, and how chance draws others."""

from dataclasses import dataclass
from math import log

import numpy as np

BALL = {
    "contact": {"radius_x": 12.7e-3, "radius_y": 12.7e-3, "reduced_modulus": 219.78e9},
    "surface": {"kind": "self-affine", "longest_wavelength": 200e-6},
    "grid": {"x": [-2.0, 1.5], "y": [-1.75, 1.75]},
}
"""Steel on a ground disc (nested tables of a configuration)."""

RMS, HURST = (20e-9, 400e-9), (0.5, 0.9)
"""From, to: roughness in m, Hurst's exponent."""


@dataclass(frozen=True)
class DrawnBall:
    """What chance chose for a ball, in SI units; `number` counts from 1 and is the seed of its surface."""

    number: int
    rms: float
    load: float
    speed: float
    hurst: float

    @property
    def title(self):
        return f"{1e9 * self.rms:.0f} nm, {self.load:.0f} N, {1e3 * self.speed:.3g} mm/s"


def by_logarithm(chance, low, high):
    """A number between two, drawn evenly by its logarithm."""
    return float(np.exp(chance.uniform(log(low), log(high))))
