"""Oils whose viscosity was measured over temperature and pressure, and viscosity between two temperatures.

T is in K, p in Pa, throughout.
"""

from dataclasses import dataclass
from math import exp, log, log10

import numpy as np

CELSIUS = 273.15
"""0 degrees C in K."""


@dataclass(frozen=True)
class OilViscosity:
    """An `Oil` at one temperature: ln(eta/eta0) = alpha p/(1 + decline p). Below p = 0 the law goes on as a
    line. A slightly negative decline ends it far beyond any contact: the denominator stays at 1/2."""

    viscosity: float
    """eta0 in Pa s."""
    pressure_viscosity: float
    """alpha in 1/Pa, the slope at p = 0."""
    decline: float
    """In 1/Pa: how fast the slope falls with the pressure."""

    def log_viscosity(self, P, p_h):
        """Return ln(eta*) and d ln(eta*)/dP, shapes as P."""
        alpha, fall = self.pressure_viscosity * p_h, self.decline * p_h
        inner = 1.0 + fall * np.maximum(P, 0.0)
        below = np.maximum(inner, 0.5)
        return alpha * P / below, np.where(inner > 0.5, alpha / below**2, alpha / below)


@dataclass(frozen=True)
class Oil:
    """eta = K exp(C/(D + T)) exp(p/(a1 + a2 T + (b1 + b2 T) p)), with where and how it was measured."""

    description: str
    source: str
    """A key of `mgehl.model.sources.SOURCES`."""
    a1: float
    a2: float
    b1: float
    b2: float
    C: float
    D: float
    K: float
    at_40: float
    """Viscosity in Pa s at 40 degrees C by the source's kinematic viscosity and density."""
    at_100: float
    """The same at 100 degrees C."""
    coldest: float = 40.0 + CELSIUS
    warmest: float = 100.0 + CELSIUS
    highest: float = 1e9
    """Largest pressure in Pa at which friction by these constants was compared with measurements."""
    unknown: str = "where the constants were fitted, and how pressure changes the density"

    def viscosity(self, T):
        """eta0 in Pa s at `T`."""
        return self.K * exp(self.C / (self.D + T))

    @property
    def off(self):
        """By what part the formula is off the table's viscosity at 40 and at 100 degrees C."""
        table = (40.0, self.at_40), (100.0, self.at_100)
        return [self.viscosity(CELSIUS + T) / eta - 1.0 for T, eta in table]

    def law(self, T):
        """The `OilViscosity` at `T`."""
        alpha = 1.0 / (self.a1 + self.a2 * T)
        return OilViscosity(self.viscosity(T), alpha, (self.b1 + self.b2 * T) * alpha)


OILS = {
    "N100": Oil(
        "naphthenic oil of ISO VG 100", "arana2019",
        -7.23e7, 3.48e5, 5.00e-3, -1.83e-5, 650.0, -206.0, 161.6e-6,
        97.9e-6 * 900.0, 8.61e-6 * 900.0,
    ),
    "M100": Oil(
        "mineral oil of ISO VG 100, FVA 3", "arana2019",
        -2.28e7, 2.26e5, -68.2e-3, 27.68e-5, 890.0, -182.0, 86.86e-6,
        96.0e-6 * 882.0, 10.6e-6 * 882.0,
    ),
    "PAO100": Oil(
        "polyalphaolefin of ISO VG 100", "arana2019",
        -5.73e7, 3.90e5, -39.5e-3, 23.54e-5, 1740.0, -116.0, 12.26e-6,
        94.1e-6 * 840.0, 14.0e-6 * 840.0,
    ),
}  # fmt: skip
"""By their names; compared with friction at 1 GPa and 60 degrees C, 2 to 16 m/s."""


def walther(at_40, at_100, T):
    """Kinematic viscosity at `T` of an oil that has `at_40` and `at_100` degrees C, all in m2/s. The
    equation of Walther, log10(log10(Z)) = A - B log10(T), with the terms of thin oils [ASTM D341]."""
    cold, warm = (log10(log10(_Z(1e6 * nu))) for nu in (at_40, at_100))
    T_40, T_100 = log10(40.0 + CELSIUS), log10(100.0 + CELSIUS)
    slope = (cold - warm) / (T_100 - T_40)
    z = 10.0**10.0 ** (cold - slope * (log10(T) - T_40)) - 0.7
    return 1e-6 * (z - exp(-0.7487 - 3.295 * z + 0.6119 * z**2 - 0.3193 * z**3))


def _Z(nu):
    """Of a kinematic viscosity in cSt, from 0.21 on; from 2 on nu + 0.7."""
    return nu + 0.7 + exp(-1.47 - 1.84 * nu - 0.51 * nu**2)


def thinning(viscosity, T):
    """beta = -d ln(eta)/dT in 1/K of a function `viscosity` of T."""
    return log(viscosity(T - 0.5) / viscosity(T + 0.5))
