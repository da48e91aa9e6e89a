"""What every lubricated contact of elastic bodies has in common.

Inside the code X = x/a, P = p/p_h and H = h R_x/a^2 (the paper divides the gap by a).
"""

from dataclasses import dataclass, replace
from math import inf, sqrt

import numpy as np

from mgehl.model import films
from mgehl.model.frame import Frame
from mgehl.model.hertz import hertz_pressure
from mgehl.model.inlet import Inlet
from mgehl.model.inlet_heat import InletHeat
from mgehl.model.lubricant import DowsonHigginson
from mgehl.model.on_bodies import OnBodies

RESOLVED_CELLS = 4.0
"""Cells in the inlet from which on the film is off by 0.4 % at the most, by the default."""


@dataclass(frozen=True)
class Groups:
    """Dimensionless groups from the dimensional values; M and L are those of Moes."""

    U: float
    W: float
    G: float
    M: float
    L: float


@dataclass(frozen=True)
class HertzUnder:
    """The Hertz contact of a load, in the units of P, X and Y that another load gives."""

    contact: "LoadedContact"
    """The contact under that load."""
    reach: float
    """Its semi-axes in units of X and Y."""
    integral: float
    """Its load: the integral of P over X and Y."""
    area: float
    """In units of X and Y; of a line contact its width."""


class LoadedContact(OnBodies, Inlet, InletHeat):
    """Scales, film and inlet of a body pressed on a lubricated flat, in SI units; `speed` is u of rho u h.

    A kind of contact adds `load`, `radius_x`, `reduced_modulus`, `speed`, `lubricant`, `friction` and
    `solids`, the dry `hertz` contact, `groups`, `smooth_gap`, `dry_gap`, the `kernel` of the deformation,
    the `load_integral` of P and the `contact_area` in units of X and Y.
    """

    is_loaded = True
    """The gap answers to the pressure, whose integral is a load."""
    is_line = False
    """It has no end across the motion."""
    counted_beyond = 0.0
    """Part of the load carried beyond the domain that the film within is spared, 0 to 1."""
    motion, angle = (1.0, 0.0), 0.0
    """The surfaces move towards +X."""

    frame = Frame()
    """The axes in which it is solved."""
    deformation = None
    """What the bodies are in depth, where they are not half-spaces."""
    widening = 1.0
    """Width of the dry contact over that of Hertz; where bodies are layered an estimate."""

    @property
    def lambda_ratio(self):
        """Film of smooth bodies over the roughness, at rest 0; None where there is next to none."""
        rms = self.roughness
        if not rms:
            return None
        return 0.0 if self.is_at_rest else self.expected_film / rms

    @property
    def asymptotes(self):
        """Moes' films, H_Moes, that formulas know: rigid and elastic isoviscous, the same piezoviscous."""
        raise NotImplementedError

    @property
    def regime(self):
        """Whether bodies and viscosity answer to the pressure, by Moes' asymptotes."""
        return films.regime(*self.in_formulas.asymptotes)

    @property
    def is_flattened(self):
        """Whether bodies are pressed flat, by Moes' isoviscous films: the pressure in the middle is p_h."""
        rigid, elastic, *_ = self.in_formulas.asymptotes
        return rigid < elastic

    @property
    def formulas(self):
        """{name: film in m} by every formula; layered bodies are half-spaces whose contact is as wide."""
        raise NotImplementedError

    @property
    def shown_formulas(self):
        """{name: film in m} of the `formulas` that are made for such bodies."""
        return {name: film for name, film in self.formulas.items() if films.applies(name, self.regime)}

    @property
    def density_ratio(self):
        """Density of the oil at p_h over that at rest."""
        return self._density_ratio(self.lubricant)

    def _density_ratio(self, oil):
        return float(oil.density(np.ones((1, 1)), self.in_formulas.hertz.p_h)[0][0, 0])

    @property
    def compared(self):
        """{name: film in m} of `shown_formulas` on the terms of what is computed: the central film of
        bodies that are pressed flat is the formula's, by the density at p_h that it assumes over the oil's.
        """
        if not self.is_flattened:
            return self.shown_formulas
        assumed_oil = replace(self.lubricant, density_law=DowsonHigginson())
        own, theirs = self.density_ratio, self._density_ratio(assumed_oil)
        found = {}
        for name, film in self.shown_formulas.items():
            assumed = 1.0 if films.formula_of(name).incompressible else theirs
            ratio = 1.0 if name.endswith("_minimum") else assumed / own
            found[name] = film * ratio
        return found

    @property
    def hardly_stiffens(self):
        """Whether pressures hardly stiffen the oil: between rubber, under light loads, in water."""
        return films.hardly_stiffens(*self.asymptotes)

    @property
    def expected_film(self):
        """Central film in metres to start from, by the formula of its regime."""
        return self.flooded_film if films.is_isoviscous(*self.asymptotes) else self._piezoviscous_film

    @property
    def is_mixed(self):
        """True where the peaks of a rough surface reach through the film that smooth bodies would have."""
        return self.roughness > self.expected_film

    @property
    def reach(self):
        """How far from the centre, in units of X and Y, the dry contact may reach. The widening by a soft
        layer is estimated, and low by up to a third."""
        return self.widening if self.widening <= 1.0 else min(self.widening**2, 1.3 * self.widening)

    def share_beyond(self, x, y):
        """Part of the load that the film in a domain need not carry, its ends in m."""
        return 0.0

    def load_within(self, mesh, there=None, sense=1.0):
        """The integral of P that the domain of a mesh takes: the load less what is missing there. Of
        another load and speed that of the contact `there`, in this one's units  [Liu eq. 50]; with a
        `sense` of -1 of one that moves the other way."""
        there = there or self
        within = 1.0 - there.share_beyond(*self.ends(mesh, sense))
        return there.load / self.load * self.load_integral * within

    def squeezed_beyond(self, mesh, film):
        """The load in N that oil squeezed out beyond the domain of a mesh carries, and what its sides take
        away within, over the speed in m/s at which the bodies approach; with a film in the middle in m.
        Of line contacts it is not counted: it falls with the cube of the distance, and the gap at their
        sides, which bodies yield by the logarithm of it, hardly follows H0."""
        return 0.0

    def drag_beyond(self, mesh, downstream=False):
        """What rolling takes from each body beyond the domain of a mesh, in N, of a line contact in N/m.
        Upstream, and `downstream` where no film tears."""
        raise NotImplementedError

    def shear_beyond(self, mesh, downstream=False):
        """What the shear of the oil there takes from surfaces that slide; as `drag_beyond`."""
        raise NotImplementedError

    @property
    def is_at_rest(self):
        """Without a speed: a dry contact."""
        return self.speed == 0.0

    @property
    def is_hertzian(self):
        """True of smooth half-spaces, whose dry contact is that of Hertz."""
        return self.surface is None and self.deformation is None

    def guessed_pressure(self, X, Y):
        """Pressure to start from: that of Hertz, `widening` times as wide."""
        wide = self.widening
        return hertz_pressure(X / wide, Y / wide) / wide**2

    @property
    def likeness(self):
        """The half-spaces with axes along and across the motion that formulas know, in contact as wide."""
        return self

    @property
    def in_formulas(self):
        """The same as far as it is known where results are read, which runs no function of the user's."""
        return self.likeness

    def in_frame(self, frame):
        """The same contact, described in a `Frame`."""
        return self

    def turned(self, angle):
        """The same contact with the motion at an angle in degrees, where it has a choice."""
        return self

    def under(self, share):
        """The same contact under `share` times its load."""
        return self if share == 1.0 else replace(self, load=share * self.load)

    def hertz_under(self, share):
        """The `HertzUnder` of `share` times the load, in this contact's units."""
        contact = self.under(share)
        reach = contact.x_scale / self.x_scale
        area = self.contact_area * (reach if self.is_line else reach**2)
        return HertzUnder(contact, reach, share * self.load_integral, area)

    def at_speed(self, speed):
        """The same contact at another entrainment speed (m/s)."""
        return replace(self, speed=speed)

    @property
    def x_scale(self):
        """Metres per unit of X: a."""
        return self.hertz.a

    @property
    def y_scale(self):
        """Metres per unit of Y: b."""
        return self.hertz.b

    def ends(self, mesh, sense=1.0):
        """Where the domain of a mesh ends along x and y, two pairs in m; with a `sense` of -1 as a motion
        the other way sees it."""
        (x0, x1), (y0, y1), a, b = mesh.x, mesh.y, self.x_scale, self.y_scale
        x, y = (x0 * a, x1 * a), (y0 * b, y1 * b)
        return (x, y) if sense > 0.0 else ((-x[1], -x[0]), (-y[1], -y[0]))

    def in_its_units(self, x, y):
        """Two pairs in m along x and y, in units of X and Y."""
        (x0, x1), (y0, y1), a, b = x, y, self.x_scale, self.y_scale
        return (x0 / a, x1 / a), (y0 / b, y1 / b)

    def cell_area(self, mesh):
        """Area of a cell of a mesh in m^2; of a line contact that of a metre of its length."""
        return mesh.dX * self.x_scale * (1.0 if mesh.is_line else mesh.dY * self.y_scale)

    @property
    def pressure_scale(self):
        """Pascals per unit of P: p_h."""
        return self.hertz.p_h

    @property
    def held(self):
        """Pressure around in Pa, above that at which film tears; inf where it never does."""
        return self.lubricant.ambient_pressure if self.tears else inf

    @property
    def tears_at(self):
        """P at which the film tears: nothing, or as far below the ambient pressure."""
        return 0.0 - self.lubricant.ambient_pressure / self.pressure_scale

    @property
    def film_scale(self):
        """Metres per unit of H: a^2/R_x."""
        return self.hertz.a**2 / self.radius_x

    @property
    def lambda_(self):
        """Reynolds coefficient lambda = 12 u eta0 R_x^2/(a^3 p_h)."""
        hertz = self.hertz
        return 12.0 * self.speed * self.lubricant.viscosity * self.radius_x**2 / (hertz.a**3 * hertz.p_h)

    @property
    def thinning(self):
        """eta V/(h tau_0) where eta* and H are 1, for `effective_mobilities`; None where nothing thins."""
        if not self.friction.thins:
            return None
        stress = self.film_scale * self.friction.rheology.eyring_stress
        return self.lubricant.viscosity * self.friction.sliding_speed(self.speed) / stress

    @property
    def approach(self):
        """Dry approach in units of H: the H0 of the Hertz contact is its negative."""
        return self.hertz.approach / self.film_scale

    @property
    def moes_scale(self):
        """H_Moes = (h/R_x)(2U)^(-1/2) per metre of film."""
        return 1.0 / (self.radius_x * sqrt(2.0 * self.groups.U))
