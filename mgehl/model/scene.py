"""A loaded contact over time: where the surfaces of its bodies are, how they move, what the load is.

Times are in s. The mean velocity of both surfaces is `speed` at an `angle`; body 1 moves at
speed (1 + S/2), body 2 at speed (1 - S/2), S the slide-to-roll ratio. Ways and paths are (x, y) in m along
the user's axes.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from mgehl.model.course import Course, integral
from mgehl.model.frame import Frame, direction
from mgehl.model.surface.surface import Surface, summed


@dataclass(frozen=True)
class Moved(Surface):
    """A surface that has gone a way (x, y) in m from where it was, on the body of a number."""

    surface: Surface
    way: tuple
    body: int = 1

    @property
    def moving(self):
        """Itself."""
        return ((self.body, self),)

    def height(self, x, y):
        """Height at x and y."""
        return self.surface.height(x - self.way[0], y - self.way[1])

    def shortest(self, x, y):
        """As where it was."""
        return self.surface.shortest(x - self.way[0], y - self.way[1])

    def reaches(self, x, y):
        """Of one from a file whether points lie within it, where it is now."""
        return self.surface.reaches(x - self.way[0], y - self.way[1])


AT_REST = 1e-3
"""Part of the largest speed below which surfaces count as at rest."""


def cells_a_step(shares):
    """What counts as cells while the mean surface goes one: those of the fastest, or twice those by which
    film and roughness pass each other (half a cell of 32 in a wave is .3 % of its amplitude, one 1.3 %)."""
    return max([1.0, *(max(abs(share), 2.0 * abs(share - 1.0)) for share in shares)])


CLOSE = 15.0
"""Degrees between directions that stand for all of them."""


def directions(angle, end):
    """Angles close together from the least to the largest of a `Course` until a time, a circle at most."""
    least, most = angle.range(end)
    most = min(most, least + 360.0)
    return np.linspace(least, most, int((most - least) / CLOSE) + 2).tolist() if least < most else [least]


LONGEST, LONGEST_ROUGH = 4.0, 2.0
"""Cells that surfaces may go in a step: smooth ones, by 8 a steady film of 127 nm walks off to 210; heights
that move: waves of 80 um on 65 nodes have a mean gap of 155 nm by one cell, 151 by 2.5, 215 by 5."""

OF_INLET, LEAST_CELLS = 0.2, 0.25
"""Part of the inlet's cells that the mean surface may go in a step, and cells that it always may. A step of
c cells makes a film from an inlet of n cells thinner by a fourth to a half of (c/n)^2 (balls on 65 and 129
nodes, lines on 129 and 257, c/n of 0.02 to 0.6); by 1.8 it was two thirds thicker."""


@dataclass(frozen=True)
class Scene:
    """What changes with time; `contact` is the one at a time of 0, in the user's axes."""

    contact: object
    speed: Course
    load: Course
    surfaces: tuple
    """(`Surface`, its body's speed over the mean one, that body's number)."""
    end: float
    angle: Course
    """Of the motion in degrees, from the user's +x towards his +y."""

    @cached_property
    def framed(self):
        """The contact at a time of 0 in the axes in which it is solved."""
        return self.contact.in_frame(self.contact.frame)

    @property
    def unit(self):
        """Seconds in a unit of T: a over the largest speed there is, which the contact has."""
        return self.framed.x_scale / self.contact.speed

    @property
    def moves(self):
        """Whether heights change with time."""
        return any(share and self._varies(surface) for surface, share, _ in self.surfaces)

    @property
    def most_asked(self):
        """Cells that surfaces may go in a step that is asked for; longer ones are cut."""
        return LONGEST_ROUGH if self.moves else LONGEST

    def most_in_inlet(self, t, mesh):
        """Cells of a mesh that the mean surface may go in a step at a time, for its film to be right."""
        there = self.instant(self.framed, t)
        return LEAST_CELLS if there.is_at_rest else max(OF_INLET * there.inlet_cells(mesh), LEAST_CELLS)

    def _varies(self, surface):
        """Whether heights vary along some direction of the motion."""
        ways = ((1.0, 0.0), (0.0, 1.0)) if self.turns else (self.contact.motion,)
        return any(map(surface.varies_along, ways))

    @cached_property
    def turns(self):
        """Whether the direction of the motion changes with time."""
        least, most = self.angle.range(self.end)
        return least != most

    def has_turned(self, t):
        """Whether the direction at a time is another than in the beginning."""
        return self.turns and self.angle.value(t) != self.contact.angle

    def velocity(self, t):
        """Of the mean surface, along the user's x and y in m/s."""
        return self.speed.value(t) * np.array(direction(self.angle.value(t)))

    def way(self, begin, end):
        """The way that the mean surface goes between two times."""
        if not self.turns:
            return self.speed.integral(begin, end) * np.array(self.contact.motion)
        kinks = sorted({t for t in (*self.speed.kinks(), *self.angle.kinks()) if begin < t < end})
        return sum(integral(self.velocity, *ends) for ends in pairwise([begin, *kinks, end]))

    @cached_property
    def stays_from(self):
        """Time from which speed, load and direction are known to stay."""
        return max(each.stays_from(self.end) for each in (self.speed, self.load, self.angle))

    def kinks(self):
        """Times at which something changes suddenly: a step in time ends there."""
        return *self.speed.kinks(), *self.load.kinks(), *self.angle.kinks()

    def bend(self, begin, end):
        """Largest part of its range by which speed, load or angle leaves a straight line meanwhile."""
        return max(each.bend(begin, end, self.end) for each in (self.speed, self.load, self.angle))

    def change(self, begin, end):
        """Largest part of its range by which speed, load or angle changes meanwhile."""
        return max(each.change(begin, end, self.end) for each in (self.speed, self.load, self.angle))

    def passage(self, share=1.0, angles=None):
        """Way in m of the mean surface on which all heights that move go the length of the Hertz contact
        under `share` times the load: as it is along `angles` in degrees, an array, or the first motion.

        A body that is slower than the mean takes longer: before it has passed, a mean is one of the few
        heights that were there.
        """
        shares = [abs(share) for surface, share, _ in self.surfaces if share and self._varies(surface)]
        there, (x, y) = self.contact.under(share), self.contact.motion
        if angles is not None:
            x, y = np.cos(np.radians(angles)), np.sin(np.radians(angles))
        return 2.0 / np.hypot(x / there.x_scale, y / there.y_scale) / min(shares, default=1.0)

    def at(self, path):
        """The contact, in the axes in which it is solved, when the mean surface has gone a `path`."""
        if not self.moves:
            return self.framed
        return replace(self.contact, surface=self.surface_at(path)).in_frame(self.contact.frame)

    def surface_at(self, path):
        """The `Surface` then, in the user's axes; None of smooth bodies."""
        if not self.moves:
            return self.contact.surface
        x, y = path
        return summed(
            Moved(surface, (share * x, share * y), body) if share else surface
            for surface, share, body in self.surfaces
        )

    def cells(self, way, mesh):
        """Cells of a mesh that contents go along X and Y by a `way`."""
        contact = self.framed
        x, y = self.contact.frame.vector(*way)
        return x / (contact.x_scale * mesh.dX), 0.0 if mesh.is_line else y / (contact.y_scale * mesh.dY)

    def most_cells(self, way, mesh):
        """The same along X or Y, whichever are more."""
        return max(map(abs, self.cells(way, mesh)))

    def fastest(self, way, mesh):
        """Cells that count for the length of a step by a `way`."""
        shares = [share for _, share, _ in self.surfaces] if self.moves else []
        return self.most_cells(way, mesh) * cells_a_step(shares)

    def instant(self, contact, t):
        """The `contact` of a time of 0, in the user's axes or those of the solve, under the load, at the
        speed and in the direction of another time.

        Where heat thins its oil, it thins that of the instant by as much as there.
        """
        return self._driven(contact, t, self.angle.value(t))

    def in_all_directions(self, contact, t):
        """The same with the motion in each direction of the run, if not in that of the time."""
        return [self._driven(contact, t, angle) for angle in directions(self.angle, self.end)]

    def _driven(self, contact, t, angle):
        """The contact under the load and at the speed of a time, in a direction of the user's axes."""
        speed, there = abs(self.speed.value(t)), contact.under(self.load_share(t))
        if self.turns:
            there = there.turned(self._axes_of(contact).angle(angle))
        there = there if speed == contact.speed else there.at_speed(speed)
        return there.heated() if contact.lubricant.thinned < 1.0 and there is not contact else there

    def _axes_of(self, contact):
        """The `Frame` in whose axes a contact of a time of 0 is described: the user's, or the solve's."""
        users = self.contact.frame
        return Frame() if contact.frame == users else users

    @cached_property
    def _speeds(self):
        """Times, and the speed at each, between which neither speed nor load turns."""
        times = sorted({*self.speed.times(self.end), *self.load.times(self.end)})
        return times, [self.speed.value(t) for t in times]

    @cached_property
    def extremes(self):
        """Times of the slowest and the fastest motion, of the lightest and the heaviest load: none at which
        the surfaces rest."""
        times, speeds = self._speeds
        moving = [t for t, u in zip(times, speeds, strict=True) if abs(u) > AT_REST * self.contact.speed]
        by = (lambda t: abs(self.speed.value(t))), self.load.value
        return sorted({pick(moving or times[:1], key=key) for key in by for pick in (min, max)})

    def sense(self, t):
        """1; -1 where the surfaces move against the direction of the motion."""
        return -1.0 if self.speed.value(t) < 0.0 else 1.0

    @property
    def senses(self):
        """All that there are in a run."""
        _, speeds = self._speeds
        return [-1.0] * (min(speeds) < 0.0) + [1.0] * (max(speeds) >= 0.0)

    @property
    def is_steady(self):
        """Whether the speed stays."""
        _, speeds = self._speeds
        return min(speeds) == max(speeds)

    @property
    def rests(self):
        """Whether the surfaces come to rest, if only to turn round."""
        _, speeds = self._speeds
        return min(speeds) < AT_REST * self.contact.speed

    @property
    def turns_round(self):
        """Whether the surfaces turn round until the end."""
        least, most = self.speed.range(self.end)
        return least < 0.0 < most

    @property
    def stands(self):
        """Whether the surfaces stand still throughout."""
        return not any(self._speeds[1])

    @property
    def slowest(self):
        """Time of the slowest motion: where the speed turns or stays, of equal ones the heaviest load.

        Of a speed that only comes from rest and goes to it the time of the largest.
        """
        times, speeds = self._speeds
        before, after = [speeds[0], *speeds], [*speeds[1:], speeds[-1]]
        found = [
            (abs(u), -self.load.value(t), t)
            for t, u, *beside in zip(times, speeds, before, after, strict=False)
            if abs(u) > AT_REST * self.contact.speed and all(abs(u) <= v * (u / abs(u)) for v in beside)
        ]
        return min(found)[2] if found else times[int(np.argmax(np.abs(speeds)))]

    def load_share(self, t):
        """The load over that of the contact."""
        return self.load.value(t) / self.contact.load
