"""How much film a domain takes away whose sides are too near: the boundary starves the inlet.

Reduced pressure is missing: on the way to the contact it grows by g/(h + g)^3, with the film h and the gap
g of the dry contact (Grubin's integral from the side on), and the film goes with a power of the part that
is left. Hamrock and Dowson's boundary m* = 1 + 3.06 [(R_x/b)^2 H]^0.58 costs a ball some 4 %. And load is
missing, below M = 8, but for what is counted of it (`far_field`). The side downstream takes nothing where
film tears at once; where the pressure around holds it together, the suction beyond that side is missing.

The constants were fitted to pairs of solutions on domains of equal cells: good to a factor of two.
"""

from dataclasses import dataclass
from functools import cached_property
from math import exp, inf, log, pi, sqrt
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from mgehl.model.contact import LoadedContact
from mgehl.model.drag import kapitza_factor

UPSTREAM, BESIDE = (0.66, 0.53), (0.08, 0.15)
"""Powers of the part of the reduced pressure that is left with which the central and the minimum film fall
at L = 10: of a line contact, on the way from upstream; of a ball, from both sides."""

SLENDER = 0.63
"""b over a of the contact whose film falls half as fast as a line contact's: fluid gets in from beside."""

RIGID, LIGHT, ELASTIC = 2.0, 3.5, 0.02
"""Power of the load with which a ball's rigid film falls, how sharply that ends as the elastic film
outgrows the rigid one, and the power that is left: M = 8 to 20 need a little more room for it."""

OUTSIDE, LINE_OUTSIDE = 1.15, 3.0
"""Load lost over that beyond a side, of point and line contacts: a side's pressure of zero lowers that
within, too, in a line contact by as much everywhere."""

UNKNOWN, UNKNOWN_BY_WIDTH = 0.02, 1.2
"""Part of the load beyond a side that is lost all the same where it is counted, of a ball, and the power of
b/a with which it grows: so far is it known."""

COUNTED = 0.5
"""Part of the reduced pressure's loss that is left where the load beyond is counted: that counts, too, what
the sides take away within (`far_field`)."""

NO_FILM = 1e-12
"""Least film, in units of H: a contact at rest has an inlet without length."""

STEPS = np.geomspace(1e-6, 1e5, 500)
"""Lengths of the way, in semi-axes of the contact, at which the integral is known."""


@dataclass(frozen=True)
class WayIn:
    """A straight way to the edge of a contact, by Grubin's integral."""

    film: float
    """In the contact; not 0."""
    gap: np.ndarray
    """Of the dry contact at `STEPS` from its edge, in the unit of the film."""

    @cached_property
    def _missing(self):
        """ln of what `missing` returns at `STEPS`."""
        grows = self.gap / (self.film + self.gap) ** 3
        pieces = 0.5 * (grows[1:] + grows[:-1]) * np.diff(STEPS)
        last = grows[-1] * STEPS[-1] / 3.0  # the gap is a parabola there
        beyond = np.append(np.cumsum(pieces[::-1])[::-1], 0.0) + last
        return np.log(-np.log1p(-beyond / (beyond[0] * (1.0 + 1e-6))))

    def missing(self, way):
        """-ln of the part of the reduced pressure that is built up on a way of this length."""
        return exp(np.interp(log(max(way, STEPS[0])), np.log(STEPS), self._missing))

    def way(self, missing):
        """The length of the way on which that much is missing."""
        return exp(np.interp(-log(missing), -self._missing, np.log(STEPS)))


class Side(NamedTuple):
    """A side of the domain."""

    toward: float
    """Cosine of the angle between the way there and the way upstream."""
    half: float
    """Metres from the centre to the edge of the dry contact."""
    unit: float
    """Metres per unit of X or Y."""


@dataclass(frozen=True)
class Starvation:
    """What a film, in m, loses by the sides of its domain."""

    contact: LoadedContact
    film: float

    def lost(self, x, y):
        """Per cent of film that a domain of twice the size has more, central or minimum, the larger. `x`
        and `y` are the ends of the domain in units of X and Y."""
        near, far = self.missing(x, y), self.missing(_twice(x), _twice(y))
        most = max(less - more for less, more in zip(near, far, strict=True))
        return 100.0 * (1.0 - exp(-most))

    def missing(self, x, y):
        """-ln of the parts of central and minimum film that the domain leaves."""
        ends = -x[0], x[1], -y[0], y[1]
        ways = [(side, end * side.unit - side.half) for side, end in zip(self.sides, ends, strict=False)]
        return [sum(self._missing_by(powers, *way) for way in ways) for powers in self.powers]

    def _missing_by(self, powers, side, room):
        """That by one side, `room` metres from the contact; one that lies askew takes some both ways."""
        room = max(room, 0.0)
        upstream, beside = (lost / (room + side.half) ** self.order for lost in self.by_load)
        part, rest = max(side.toward, 0.0) ** 2, 0.5 * (1.0 - side.toward**2)
        if part:
            upstream += powers[0] * self.upstream.missing(room / (side.toward * self.like.hertz.a))
        if rest:
            beside += powers[1] * self.beside.missing(room / self.like.hertz.b)
        behind = max(-side.toward, 0.0) ** 2 * self.behind(room + side.half)
        return part * upstream + rest * beside + behind

    @cached_property
    def sides(self):
        """The `Side`s at the beginning and at the end of x, then of y."""
        contact, (c, s) = self.contact, self.contact.motion
        a, b, wide = contact.x_scale, contact.y_scale, contact.widening
        along_x = [Side(toward, wide * a, a) for toward in (c, -c)]
        return (
            along_x if contact.is_line else [*along_x, *(Side(toward, wide * b, b) for toward in (s, -s))]
        )

    @cached_property
    def like(self):
        """The contact that stands for this one."""
        return self.contact.likeness

    @property
    def dimensionless_film(self):
        """In units of H."""
        return max(self.film / self.like.film_scale, NO_FILM)

    @cached_property
    def upstream(self):
        """The `WayIn` along the motion."""
        return WayIn(self.dimensionless_film, self.like.dry_gap(1.0 + STEPS, np.zeros(STEPS.size)))

    @cached_property
    def beside(self):
        """The `WayIn` across it."""
        return WayIn(self.dimensionless_film, self.like.dry_gap(np.zeros(STEPS.size), 1.0 + STEPS))

    @cached_property
    def powers(self):
        """Those of the reduced pressure (upstream, beside), for the central and for the minimum film."""
        L, wide = self.like.groups.L, inf if self.contact.is_line else 1.0 / self.like.k_e
        # Isoviscous films answer less to the pressure of the inlet.
        answer = 0.36 + 0.96 * L / (L + 5.0)
        answer *= 1.0 - (1.0 - COUNTED) * self.contact.counted_beyond
        upstream, beside = answer / (1.0 + (SLENDER / wide) ** 2), 2.0 * answer / (1.0 + wide**1.6)
        return [(upstream * up, beside * by) for up, by in zip(UPSTREAM, BESIDE, strict=True)]

    @property
    def order(self):
        """Power of the distance with which the load beyond it falls."""
        return 2 if self.contact.is_line else 1

    @cached_property
    def by_load(self):
        """-ln of the film left without the load beyond a side, times its distance in m to the `order`.
        Upstream and beside."""
        like = self.like
        x, y = like.radius_x, inf if self.contact.is_line else like.radius_y
        share = self._answer_to_load * kapitza_factor(like.lubricant, like.speed, x, y) * x / like.load
        unknown = min(UNKNOWN * max(1.0, 1.0 / like.k_e) ** UNKNOWN_BY_WIDTH, 1.0)
        share *= 1.0 - (1.0 - unknown) * self.contact.counted_beyond
        if self.contact.is_line:
            return LINE_OUTSIDE * share * 2.0 * x, 0.0
        return OUTSIDE * share * 2.0 * pi * sqrt(x * y), OUTSIDE * share * 4.0 * y

    @cached_property
    def torn_until(self):
        """Metres behind the contact up to which Kapitza's suction tears the film; inf where film tears as
        soon as it is sucked."""
        like = self.like
        if not like.held:
            return inf
        y = inf if self.contact.is_line else like.radius_y
        K = kapitza_factor(like.lubricant, like.speed, like.radius_x, y)
        return (4.0 * K * like.radius_x**2 / like.held) ** (1.0 / 3.0)

    def behind(self, way):
        """-ln of the film left without the suction that lies farther behind the contact than `way`, in m:
        as much as presses upstream; where film is torn, no more than the pressure around."""
        whole = max(way, self.torn_until)
        torn = 1.0 - way / whole
        torn = 2.0 * torn if self.contact.is_line else torn * (1.0 - 0.5 * torn)
        return self.by_load[0] / whole**self.order * (1.0 + torn)

    def way_behind(self, lost):
        """The way, in m, behind which `behind` is so much; at the least the contact's half-width."""
        nearest = self.like.hertz.a
        if self.behind(nearest) <= lost:
            return nearest
        farthest = 2.0 * (self.by_load[0] / lost) ** (1.0 / self.order)
        return brentq(lambda way: self.behind(way) - lost, nearest, farthest)

    @property
    def _answer_to_load(self):
        """Power of the load with which the film falls: of a rigid one, where that is the thickest."""
        like = self.like
        if self.contact.is_line:
            rigid, elastic, *piezoviscous = like.asymptotes
            return 1.0 / (1.0 + (max(elastic, min(piezoviscous)) / rigid) ** LIGHT)
        rigid, elastic, *_ = like.asymptotes
        # Less of wide contacts, by as much as they are wide.
        return min(1.0, like.k_e) * (RIGID / (1.0 + (elastic / rigid) ** LIGHT) + ELASTIC)


def _twice(ends):
    return 2.0 * ends[0], 2.0 * ends[1]
