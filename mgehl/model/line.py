"""The lubricated line contact: a cylinder on a flat, per metre of its length."""

from dataclasses import dataclass
from functools import cached_property
from math import pi

from mgehl.model import films
from mgehl.model.contact import Groups, LoadedContact
from mgehl.model.deformation import HalfPlane
from mgehl.model.drag import line_drag_beyond, line_shear_beyond
from mgehl.model.flash import Solid
from mgehl.model.hertz import hertz_line_contact, hertz_line_gap
from mgehl.model.lubricant import Lubricant
from mgehl.model.rheology import Friction
from mgehl.model.surface import Surface


@dataclass(frozen=True)
class LineContact(LoadedContact):
    """A cylinder pressed on a lubricated flat; load in N per metre of length."""

    load: float
    radius_x: float
    reduced_modulus: float
    speed: float
    lubricant: Lubricant
    surface: Surface | None = None
    friction: Friction = Friction()
    """How the surfaces slide over each other."""
    solids: tuple[Solid, Solid] | None = None
    """What both bodies make of heat; None where it is not known."""
    tears: bool = True
    """Whether film tears where nothing is left of the pressure around."""

    is_line = True

    load_integral = pi / 2.0
    """The integral of P over X: that of sqrt(1 - X^2)."""
    contact_area = 2.0
    """Width of the Hertz contact in units of X."""
    k_e = 1.0

    @cached_property
    def hertz(self):
        """The dry contact of the same bodies under the same load."""
        return hertz_line_contact(self.load, self.radius_x, self.reduced_modulus)

    @property
    def deflection_scale(self):
        """Factor of the integral of -P ln|x/a|: 4 p_h R/(pi E' a), which is 1/pi."""
        return 4.0 * self.hertz.p_h * self.radius_x / (pi * self.reduced_modulus * self.hertz.a)

    @property
    def kernel(self):
        """The deformation: that of two half-planes."""
        return HalfPlane(self.deflection_scale)

    def smooth_gap(self, X, _Y):
        """The parabola x^2/2R in units of H  [Liu eq. 48]."""
        return 0.5 * X**2

    def dry_gap(self, X, _Y):
        """Gap of the Hertz contact in units of H."""
        return hertz_line_gap(X)

    def drag_beyond(self, mesh, downstream=False):
        """By the film between the cylinders as they are pressed."""
        return line_drag_beyond(self, mesh.x, downstream)

    def shear_beyond(self, mesh, downstream=False):
        """By the same film."""
        return line_shear_beyond(self, mesh.x, downstream)

    @property
    def groups(self):
        """U, W, G from the dimensional values, and Moes' M and L of the line contact."""
        U = self.lubricant.viscosity * self.speed / (self.reduced_modulus * self.radius_x)
        W = self.load / (self.reduced_modulus * self.radius_x)
        G = self.lubricant.pressure_viscosity * self.reduced_modulus
        return Groups(U, W, G, M=W * (2.0 * U) ** -0.5, L=G * (2.0 * U) ** 0.25)

    @property
    def formulas(self):
        """As of any contact."""
        pair = films.both("dowson_higginson", films.dowson_higginson(self.groups, self.radius_x))
        return pair | {"moes": self.flooded_film, "grubin": self.grubin_film}

    @property
    def asymptotes(self):
        """As of any contact."""
        return films.line_asymptotes(self.groups)

    @property
    def _piezoviscous_film(self):
        return films.dowson_higginson(self.groups, self.radius_x)[0]

    @property
    def flooded_film(self):
        """Central film in metres that a formula for every regime predicts."""
        return films.moes_line(self.groups, self.radius_x)
