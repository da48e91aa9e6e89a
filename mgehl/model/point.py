"""The lubricated point contact: SI parameters in, dimensionless problem out (Y = y/b)."""

from dataclasses import dataclass, replace
from functools import cached_property
from math import cos, pi, radians, sin, sqrt

from mgehl.model import films
from mgehl.model.coating import Coating
from mgehl.model.contact import Groups, LoadedContact
from mgehl.model.deformation import HalfSpace, LayeredHalfSpace
from mgehl.model.drag import point_drag_beyond, point_shear_beyond
from mgehl.model.far_field import missing_by_squeeze, missing_share
from mgehl.model.flash import Solid
from mgehl.model.frame import Frame, SurfaceInFrame, direction
from mgehl.model.hertz import hertz_contact, hertz_gap
from mgehl.model.images import fit_images
from mgehl.model.lubricant import Lubricant
from mgehl.model.own_laws import OwnCompliance
from mgehl.model.rheology import Friction
from mgehl.model.surface import Surface

LOAD = 2.0 * pi / 3.0
"""Dimensionless load: the integral of P over X and Y  [Liu eq. 50]."""

COUNTED_FROM, COUNTED_WHOLLY = 0.1, 0.33
"""Film of rigid bodies over that of elastic ones from which on a part of the load beyond the domain is
counted, and from which on all of it: balls of M = 15.6 and 8.2. The more the bodies float, the more the
film answers to the load; a part in between, so that films do not jump."""


def radii_along(angle, radius_x, radius_y):
    """Radii of curvature along and across a direction, an angle in degrees from x."""
    if radius_x == radius_y:
        return radius_x, radius_y
    frame, acute = Frame.of(angle)
    first, second = frame.pair(radius_x, radius_y)
    c, s = cos(radians(acute)) ** 2, sin(radians(acute)) ** 2
    return 1.0 / (c / first + s / second), 1.0 / (s / first + c / second)


@dataclass(frozen=True)
class PointContact(LoadedContact):
    """A paraboloid pressed on a lubricated flat; load in N."""

    load: float
    radius_x: float
    radius_y: float
    reduced_modulus: float
    speed: float
    lubricant: Lubricant
    surface: Surface | None = None
    deformation: Coating | OwnCompliance | None = None
    """What the bodies are in depth, if not half-spaces of the reduced modulus."""
    angle: float = 0.0
    """Direction of the motion in degrees, from +x towards +y."""
    load_beyond: bool | None = None
    """Whether the load that is carried beyond the domain is counted; None: where the film answers to it."""
    friction: Friction = Friction()
    """How the surfaces slide over each other."""
    solids: tuple[Solid, Solid] | None = None
    """What both bodies make of heat; None where it is not known."""
    tears: bool = True
    """Whether film tears where nothing is left of the pressure around."""

    load_integral = LOAD
    contact_area = pi
    """Of the Hertz ellipse in units of X and Y."""

    @classmethod
    def from_moes(cls, M, L, radius_x, radius_y, reduced_modulus, lubricant, angle=0.0, **more):
        """The contact with Moes numbers M and L: load and speed follow from the rest."""
        two_U = (L / (lubricant.pressure_viscosity * reduced_modulus)) ** 4
        along, _ = radii_along(angle, radius_x, radius_y)
        load = M * two_U**0.75 * reduced_modulus * along**2
        speed = 0.5 * two_U * reduced_modulus * along / lubricant.viscosity
        return cls(load, radius_x, radius_y, reduced_modulus, speed, lubricant, angle=angle, **more)

    @property
    def motion(self):
        """Parts of the surfaces' velocity along x and y, in units of the speed."""
        return direction(self.angle)

    @property
    def frame(self):
        """The `Frame` in which it is solved."""
        return Frame.of(self.angle)[0]

    @cached_property
    def aligned(self):
        """The contact with the same curvatures along and across the motion: what formulas know."""
        if self.angle == 0.0:
            return self
        along, across = radii_along(self.angle, self.radius_x, self.radius_y)
        return replace(self, radius_x=along, radius_y=across, angle=0.0)

    def in_frame(self, frame):
        """The same contact described in a `Frame`."""
        if frame == Frame():
            return self
        radius_x, radius_y = frame.pair(self.radius_x, self.radius_y)
        surface = self.surface and SurfaceInFrame(self.surface, frame)
        angle = frame.angle(self.angle)
        return replace(self, radius_x=radius_x, radius_y=radius_y, surface=surface, angle=angle)

    def turned(self, angle):
        """The same contact with the motion at another angle."""
        return self if angle == self.angle else replace(self, angle=angle)

    @cached_property
    def hertz(self):
        """The dry contact of the same bodies under the same load."""
        return hertz_contact(self.load, self.radius_x, self.radius_y, self.reduced_modulus)

    @property
    def k_e(self):
        """Axis ratio a/b  [Liu eq. 26]."""
        return self.hertz.a / self.hertz.b

    @property
    def deflection_scale(self):
        """Factor of the integral of P/r over x/a and y/a: 2 p_h R_x/(pi E' a)  [Liu eq. 49]."""
        return 2.0 * self.hertz.p_h * self.radius_x / (pi * self.reduced_modulus * self.hertz.a)

    @property
    def kernel(self):
        """The deformation, in units of a, p_h and H."""
        if self.deformation is None:
            return HalfSpace(self.deflection_scale)
        return LayeredHalfSpace(self.deflection_scale, self._images)

    @cached_property
    def _images(self):
        return fit_images(lambda k: self.deformation.compliance(k / self.hertz.a))

    @cached_property
    def widening(self):
        """Estimate of the dry contact's width over that of Hertz: 1 for half-spaces."""
        if self.deformation is None:
            return 1.0
        return self._images.widening(1.0 / sqrt(self.k_e))

    @cached_property
    def likeness(self):
        """The half-spaces with axes along and across the motion that formulas know, in contact as wide."""
        like = self.aligned
        if like.deformation is None:
            return like
        return replace(like, reduced_modulus=like.reduced_modulus / like.widening**3, deformation=None)

    @property
    def hardly_yields(self):
        """By Moes' isoviscous films: that of rigid bodies is thicker than that of elastic ones."""
        rigid, elastic, *_ = self.asymptotes
        return rigid > elastic

    @property
    def counted_beyond(self):
        """Part of the load carried beyond the domain that the film within is spared, 0 to 1."""
        if self.is_at_rest:
            return 0.0
        if self.load_beyond is not None:
            return float(self.load_beyond)
        rigid, elastic, *_ = self.asymptotes
        above = (rigid / elastic - COUNTED_FROM) / (COUNTED_WHOLLY - COUNTED_FROM)
        return min(max(above, 0.0), 1.0)

    @property
    def asymptotes(self):
        """As of any contact."""
        like = self.likeness
        return films.point_asymptotes(like.groups, like.radius_x / like.radius_y)

    def share_beyond(self, x, y):
        """As of any contact."""
        counted = self.counted_beyond
        return counted * missing_share(self, x, y) if counted else 0.0

    def squeezed_beyond(self, mesh, film):
        """By a film between paraboloids."""
        return 0.0 if self.load_beyond is False else missing_by_squeeze(self, *self.ends(mesh), film)

    def drag_beyond(self, mesh, downstream=False):
        """By the film between the bodies as they are pressed, as far as they are paraboloids."""
        return point_drag_beyond(self, mesh.x, mesh.y, downstream)

    def shear_beyond(self, mesh, downstream=False):
        """By the same film, as far."""
        return point_shear_beyond(self, mesh.x, mesh.y, downstream)

    def _inlet_of(self, film):
        """As of any contact, in units of this one's a."""
        like = self.likeness
        return super(PointContact, like)._inlet_of(film) * like.hertz.a / self.hertz.a

    def cell_along_motion(self, mesh):
        """|c|^3 dX + |s|^3 dY/k_e of a motion along (c, s): twice the diffusion along it of scheme 1B."""
        c, s = (abs(part) for part in self.motion)
        return c**3 * mesh.dX + s**3 * mesh.dY / self.k_e

    def smooth_gap(self, X, Y):
        """The paraboloid x^2/2R_x + y^2/2R_y in units of H  [Liu eq. 48]."""
        side = self.radius_x / (self.radius_y * self.k_e**2)
        return 0.5 * X**2 + 0.5 * side * Y**2

    def dry_gap(self, X, Y):
        """Gap of the Hertz contact in units of H."""
        x, y = X * self.x_scale, Y * self.y_scale
        return hertz_gap(self.hertz, self.reduced_modulus, x, y) / self.film_scale

    @property
    def groups(self):
        """U, W, G by the radius along the motion, and Moes' M and L."""
        radius = self.aligned.radius_x
        U = self.lubricant.viscosity * self.speed / (self.reduced_modulus * radius)
        W = self.load / (self.reduced_modulus * radius**2)
        G = self.lubricant.pressure_viscosity * self.reduced_modulus
        return Groups(U, W, G, M=W * (2.0 * U) ** -0.75, L=G * (2.0 * U) ** 0.25)

    @property
    def formulas(self):
        """As of any contact; that made for any direction too, where the motion is not across the longer
        axis."""
        like, groups = self.in_formulas, self.in_formulas.groups
        radii, ellipse = (like.radius_x, like.radius_y), (like.radius_x, 1.0 / like.k_e)
        oblique = 0.0 not in self.motion or like.radius_x > like.radius_y
        return {
            **films.both("hamrock_dowson", films.hamrock_dowson(groups, *ellipse)),
            "nijenbanning_venner_moes": films.nijenbanning_venner_moes(groups, *radii),
            "grubin": like.grubin_film,
            **films.both("hamrock_dowson_soft", films.hamrock_dowson_soft(groups, *ellipse)),
            **(films.both("chittenden", films.chittenden(groups, *radii)) if oblique else {}),
        }

    @property
    def moes_scale(self):
        """H_Moes = (h/R)(2U)^(-1/2) per metre of film, R the radius along the motion."""
        return super(PointContact, self.aligned).moes_scale

    @property
    def in_formulas(self):
        """As of any contact; a deformation of the user's own counts as none."""
        own = isinstance(self.deformation, OwnCompliance)
        return replace(self.aligned, deformation=None) if own else self.likeness

    @property
    def _piezoviscous_film(self):
        like = self.likeness
        return films.hamrock_dowson(like.groups, like.radius_x, 1.0 / like.k_e)[0]

    @property
    def flooded_film(self):
        """Central film in metres that a formula for every regime predicts."""
        like = self.likeness
        return films.nijenbanning_venner_moes(like.groups, like.radius_x, like.radius_y)
