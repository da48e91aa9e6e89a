"""A loaded contact over time: where the surfaces of its bodies are, how fast they move, what the load is.

Times are in s. The mean velocity of both surfaces is `speed` along the contact's own direction; body 1
moves at speed (1 + S/2), body 2 at speed (1 - S/2), S the slide-to-roll ratio.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mgehl.model.course import Course
from mgehl.model.surface.surface import Surface, summed


@dataclass(frozen=True)
class Moved(Surface):
    """A surface that has gone a way (x, y) in m from where it was."""

    surface: Surface
    way: tuple

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


@dataclass(frozen=True)
class Scene:
    """What changes with time; `contact` is the one at a time of 0, in the user's axes."""

    contact: object
    speed: Course
    load: Course
    surfaces: tuple
    """(`Surface`, its body's speed over the mean one)."""
    end: float

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
        along = self.contact.motion
        return any(share and surface.varies_along(along) for surface, share in self.surfaces)

    def passage(self, share=1.0):
        """Way in m of the mean surface on which all heights that move go the length of the Hertz contact
        under `share` times the load.

        A body that is slower than the mean takes longer: before it has passed, a mean is one of the few
        heights that were there.
        """
        along = self.contact.motion
        shares = [abs(share) for surface, share in self.surfaces if share and surface.varies_along(along)]
        return 2.0 * self.framed.under(share).x_scale / min([1.0, *shares])

    def at(self, path):
        """The contact, in the axes in which it is solved, when the mean surface has gone a `path` in m."""
        if not self.moves or path == 0.0:
            return self.framed
        return replace(self.contact, surface=self.surface_at(path)).in_frame(self.contact.frame)

    def surface_at(self, path):
        """The `Surface` then, in the user's axes; None of smooth bodies."""
        if not self.moves or path == 0.0:
            return self.contact.surface
        return summed(self._moved(surface, share * path) for surface, share in self.surfaces)

    def _moved(self, surface, path):
        x, y = self.contact.motion
        return Moved(surface, (x * path, y * path)) if path else surface

    def cells(self, path, mesh):
        """Cells of a mesh that contents go along X and Y by a `path` in m."""
        contact = self.framed
        along_x = path * contact.motion[0] / (contact.x_scale * mesh.dX)
        return along_x, 0.0 if mesh.is_line else path * contact.motion[1] / (contact.y_scale * mesh.dY)

    def fastest(self, path, mesh):
        """Cells along X that count for the length of a step by a `path`."""
        shares = [share for _, share in self.surfaces] if self.moves else []
        return abs(self.cells(path, mesh)[0]) * cells_a_step(shares)

    def instant(self, contact, t):
        """The `contact` of a time of 0, in any axes, under the load and at the speed of another time.

        Where heat thins its oil, it thins that of the instant by as much as there.
        """
        speed, there = abs(self.speed.value(t)), contact.under(self.load_share(t))
        there = there if speed == contact.speed else there.at_speed(speed)
        return there.heated() if contact.lubricant.thinned < 1.0 and there is not contact else there

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
