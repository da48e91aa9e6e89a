"""Constitutive laws of the lubricant as pure functions of the dimensionless pressure.

Every law returns the value and its derivative with respect to P = p/p_h, so that the
residual and its linearisation cannot drift apart.
"""

from dataclasses import dataclass
from functools import cached_property
from math import log

import numpy as np

from mgehl.model.oils import OilViscosity
from mgehl.model.own_laws import OwnDensity, OwnViscosity

ROELANDS_PRESSURE = 1.0 / 5.1e-9
"""Pressure constant of Roelands' law in Pa."""


@dataclass(frozen=True)
class Barus:
    """Exponential law ln(eta/eta0) = alpha p  [Liu eq. 46]."""

    viscosity: float
    """eta0 in Pa s."""
    pressure_viscosity: float
    """alpha in 1/Pa."""

    def log_viscosity(self, P, p_h):
        """Return ln(eta*) and d ln(eta*)/dP, shapes as P."""
        alpha_bar = self.pressure_viscosity * p_h
        return alpha_bar * P, alpha_bar


@dataclass(frozen=True)
class Roelands:
    """ln(eta/eta0) = (ln eta0 + 9.67) ((1 + 5.1e-9 p)^z - 1), slope alpha at p = 0. Raises ValueError when
    ln(eta0) + 9.67 is not positive, where the law has no meaning."""

    viscosity: float
    pressure_viscosity: float

    def __post_init__(self):
        if self._scale <= 0.0:
            raise ValueError("Roelands' law needs a viscosity above 6.3e-5 Pa s")

    @property
    def _scale(self):
        return log(self.viscosity) + 9.67

    @property
    def z(self):
        """The exponent; measured oils have 0.4 to 0.8."""
        return self.pressure_viscosity * ROELANDS_PRESSURE / self._scale

    def log_viscosity(self, P, p_h):
        """Return ln(eta*) and d ln(eta*)/dP, shapes as P."""
        z = self.z
        pressure = p_h / ROELANDS_PRESSURE
        power = (1.0 + pressure * np.maximum(P, 0.0)) ** z
        slope = self._scale * z * pressure * power / (1.0 + pressure * np.maximum(P, 0.0))
        return self._scale * (power - 1.0), slope


@dataclass(frozen=True)
class ConstantViscosity:
    """eta* = 1."""

    viscosity: float
    pressure_viscosity = 0.0

    def log_viscosity(self, P, _p_h):
        """Return ln(eta*) and d ln(eta*)/dP, shapes as P."""
        return np.zeros_like(P), np.zeros_like(P)


@dataclass(frozen=True)
class DowsonHigginson:
    """rho* = 1 + 0.6e-9 p / (1 + 1.7e-9 p), p in Pa  [Liu eq. 47]."""

    def density(self, P, p_h):
        """Return rho* and d rho*/dP, shapes as P."""
        rise, softening = 0.6e-9 * p_h, 1.7e-9 * p_h
        denominator = 1.0 + softening * P
        return 1.0 + rise * P / denominator, rise / denominator**2


@dataclass(frozen=True)
class ConstantDensity:
    """rho* = 1."""

    def density(self, P, p_h):
        """Return rho* and d rho*/dP, shapes as P."""
        return np.ones_like(P), np.zeros_like(P)


USUAL_CONDUCTIVITY = 0.14
"""Of oils, in W/(m K)."""

VISCOSITY_LAWS = {"barus": Barus, "roelands": Roelands, "constant": ConstantViscosity}
DENSITY_LAWS = {"dowson-higginson": DowsonHigginson, "constant": ConstantDensity}


@dataclass(frozen=True)
class Lubricant:
    """A viscosity law and a density law."""

    viscosity_law: Barus | Roelands | OilViscosity | ConstantViscosity | OwnViscosity
    density_law: DowsonHigginson | ConstantDensity | OwnDensity
    conductivity: float | None = None
    """In W/(m K); None where it is not known."""
    thermoviscosity: float | None = None
    """beta of eta ~ exp(-beta T), in 1/K; None where it is not known."""
    thinned: float = 1.0
    """Part of the viscosity that the heat of shear leaves in the inlet."""
    ambient_pressure: float = 0.0
    """Pressure around the contact in Pa, above that at which oil tears; P and values are over it."""

    @property
    def viscosity(self):
        """eta0 in Pa s, as the inlet has it."""
        return self.thinned * self.cold_viscosity

    @property
    def cold_viscosity(self):
        """The same before the heat of shear thins it."""
        return self.viscosity_law.viscosity * float(np.exp(self._ambient_log_viscosity[0]))

    @property
    def pressure_viscosity(self):
        """alpha in 1/Pa, the slope at the ambient pressure."""
        return self._ambient_log_viscosity[1]

    def log_viscosity(self, P, p_h):
        """Return ln(eta/eta0) and its derivative by P, p_h P above the ambient pressure; shapes as P."""
        if not self.ambient_pressure:
            return self.viscosity_law.log_viscosity(P, p_h)
        value, slope = self.viscosity_law.log_viscosity(P + self.ambient_pressure / p_h, p_h)
        return value - self._ambient_log_viscosity[0], slope

    def density(self, P, p_h):
        """Return the density over that at the ambient pressure and its derivative by P, as before."""
        if not self.ambient_pressure:
            return self.density_law.density(P, p_h)
        found = self.density_law.density(P + self.ambient_pressure / p_h, p_h)
        return tuple(each / self._ambient_density for each in found)

    @cached_property
    def _ambient_log_viscosity(self):
        """ln(eta/eta where p = 0) and its slope in 1/Pa at the ambient pressure."""
        if not self.ambient_pressure:
            return 0.0, self.viscosity_law.pressure_viscosity
        return _at(self.viscosity_law.log_viscosity, self.ambient_pressure)

    @cached_property
    def _ambient_density(self):
        return _at(self.density_law.density, self.ambient_pressure)[0]


def _at(law, p):
    """What a law of the pressure gives at `p` in Pa, and its derivative in 1/Pa."""
    found = (np.broadcast_to(each, (1, 1)) for each in law(np.full((1, 1), p), 1.0))
    return tuple(float(each[0, 0]) for each in found)
