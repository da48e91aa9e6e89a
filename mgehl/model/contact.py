"""The lubricated point contact: SI parameters in, dimensionless problem out.

Inside the code X = x/a, Y = y/b, P = p/p_h and H = h R_x/a^2 (the paper divides the gap by a).
"""

from dataclasses import dataclass, replace
from functools import cached_property
from math import pi, sqrt

from mgehl.model import films
from mgehl.model.hertz import edge_gap_coefficient, hertz_contact
from mgehl.model.lubricant import Lubricant

LOAD = 2.0 * pi / 3.0
"""Dimensionless load: the integral of P over X and Y  [Liu eq. 50]."""


@dataclass(frozen=True)
class Groups:
    """Dimensionless groups from the dimensional values; M and L are those of Moes."""

    U: float
    W: float
    G: float
    M: float
    L: float


@dataclass(frozen=True)
class FilmFormulas:
    """Film thicknesses in metres that formulas predict."""

    hamrock_dowson_central: float
    hamrock_dowson_minimum: float
    nijenbanning_venner_moes: float
    grubin: float


@dataclass(frozen=True)
class PointContact:
    """A paraboloid pressed on a lubricated flat, all values in SI units.

    `speed` is the entrainment speed u of the Couette flow rho u h.
    """

    load: float
    radius_x: float
    radius_y: float
    reduced_modulus: float
    speed: float
    lubricant: Lubricant

    @classmethod
    def from_moes(cls, M, L, radius_x, radius_y, reduced_modulus, lubricant):
        """The contact with Moes numbers M and L: load and speed follow from the rest."""
        two_U = (L / (lubricant.pressure_viscosity * reduced_modulus)) ** 4
        load = M * two_U**0.75 * reduced_modulus * radius_x**2
        speed = 0.5 * two_U * reduced_modulus * radius_x / lubricant.viscosity
        return cls(load, radius_x, radius_y, reduced_modulus, speed, lubricant)

    def at_speed(self, speed):
        """The same contact at another entrainment speed (m/s)."""
        return replace(self, speed=speed)

    @cached_property
    def hertz(self):
        """The dry contact of the same bodies under the same load."""
        return hertz_contact(self.load, self.radius_x, self.radius_y, self.reduced_modulus)

    @property
    def film_scale(self):
        """Metres per unit of H: a^2/R_x."""
        return self.hertz.a**2 / self.radius_x

    @property
    def k_e(self):
        """Axis ratio a/b  [Liu eq. 26]."""
        return self.hertz.a / self.hertz.b

    @property
    def lambda_(self):
        """Reynolds coefficient lambda = 12 u eta0 R_x^2/(a^3 p_h)."""
        hertz = self.hertz
        return 12.0 * self.speed * self.lubricant.viscosity * self.radius_x**2 / (hertz.a**3 * hertz.p_h)

    @property
    def deflection_scale(self):
        """Factor of the integral of P/r over x/a and y/a: 2 p_h R_x/(pi E' a)  [Liu eq. 49]."""
        return 2.0 * self.hertz.p_h * self.radius_x / (pi * self.reduced_modulus * self.hertz.a)

    @property
    def approach(self):
        """Dry approach in units of H: the H0 of the Hertz contact is its negative."""
        return self.hertz.approach / self.film_scale

    def undeformed_gap(self, X, Y):
        """The paraboloid x^2/2R_x + y^2/2R_y in units of H  [Liu eq. 48]."""
        side = self.radius_x / (self.radius_y * self.k_e**2)
        return 0.5 * X**2 + 0.5 * side * Y**2

    @property
    def groups(self):
        """U, W, G from the dimensional values, and Moes' M and L."""
        U = self.lubricant.viscosity * self.speed / (self.reduced_modulus * self.radius_x)
        W = self.load / (self.reduced_modulus * self.radius_x**2)
        G = self.lubricant.pressure_viscosity * self.reduced_modulus
        return Groups(U, W, G, M=W * (2.0 * U) ** -0.75, L=G * (2.0 * U) ** 0.25)

    @property
    def moes_scale(self):
        """H_Moes = (h/R_x)(2U)^(-1/2) per metre of film."""
        return 1.0 / (self.radius_x * sqrt(2.0 * self.groups.U))

    @property
    def formulas(self):
        """What the film formulas say of this contact."""
        central, minimum = films.hamrock_dowson(self.groups, self.radius_x, 1.0 / self.k_e)
        moes = films.nijenbanning_venner_moes(self.groups, self.radius_x, self.radius_y)
        return FilmFormulas(central, minimum, moes, self._grubin_film)

    @property
    def _edge_gap(self):
        return edge_gap_coefficient(self.hertz, self.reduced_modulus)

    @property
    def _grubin_film(self):
        lubricant = self.lubricant
        return films.grubin(
            lubricant.pressure_viscosity, lubricant.viscosity, self.speed, self.hertz.a, self._edge_gap
        )

    @property
    def inlet_length(self):
        """Length of the zone that builds the film, in units of a: s* = (h/C)^(2/3)."""
        return (self._grubin_film / self._edge_gap) ** (2.0 / 3.0)

    def matched_speed(self, dX, cells):
        """Lowest speed not below `speed` that keeps `cells` cells of size dX in the inlet.

        s* grows with the square root of u, so the speed follows in one step.
        """
        return self.speed * max(1.0, (cells * dX / self.inlet_length) ** 2)
