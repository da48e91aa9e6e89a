"""What a law of the lubricant is told: the one argument of built-in laws of shear and of all own ones."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Conditions:
    """Where a law is asked: arrays of one shape, or numbers that hold everywhere. What a later law may need
    besides becomes one more of these: no function has to be written anew."""

    pressure: np.ndarray
    """In Pa, never negative."""
    viscosity: np.ndarray | float | None = None
    """In Pa s: a law of the viscosity is told that at no pressure, a law of the shear stress that of oil
    that is hardly sheared, at this pressure; in layers under contact at the fluid's, which is lower."""
    pressure_viscosity: float | None = None
    """d ln(eta)/dp at no pressure in 1/Pa, of a law of the viscosity."""
    shear_rate: np.ndarray | None = None
    """In 1/s, never negative, of a law of the shear stress."""
    temperature: float | None = None
    """In K; None where the configuration names none."""
