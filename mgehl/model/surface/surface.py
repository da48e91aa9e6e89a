"""What a solve asks of a surface: heights anywhere, its shortest wave, itself as a coarse grid sees it.

A peak is positive and lowers the gap: the paper's delta  [Liu eq. 48].
"""

from dataclasses import dataclass

import numpy as np

from mgehl.model.surface.shortest import shortest_of
from mgehl.model.surface.smoothing import smoothed

JUST = 1e-9
"""A wave is as long as a filter's cut-off where it is shorter by no more than this part of it."""


class Surface:
    """Heights in m. Points are arrays x and y in m from the contact's centre that broadcast together."""

    function = None
    """The user's own function that gives the heights, where there is one."""

    def height(self, x, y):
        """Height at x and y, in the shape of both together."""
        raise NotImplementedError

    def shortest(self, x, y):
        """Shortest wavelength in m; `inf` of one without waves. Where it is not known it is told from the
        heights at the nodes x (nx,) and y (ny,)."""
        return shortest_of(self.height(x[None, :], y[:, None]), step_of(x), step_of(y))

    def filtered(self, wavelengths, x, y):
        """The surface without waves shorter than `wavelengths` along x and along y, in m.

        Where waves are not known one by one, heights are sampled as far apart as the nodes x (nx,) and
        y (ny,), and not beyond them.
        """
        return Smoothed(self, wavelengths, (step_of(x), step_of(y)), (ends_of(x), ends_of(y)))

    def varies_along(self, direction):
        """Whether heights change along a direction, parts along x and y of a unit vector."""
        return True

    @property
    def moving(self):
        """(Number of its body, the part) of each part that moves."""
        return ()


@dataclass(frozen=True)
class Sum(Surface):
    """Heights of several surfaces together."""

    parts: tuple

    @property
    def function(self):
        """That of the part that has one."""
        return next((part.function for part in self.parts if part.function), None)

    def height(self, x, y):
        """The sum."""
        return sum(part.height(x, y) for part in self.parts)

    def shortest(self, x, y):
        """That of the part with the shortest."""
        return min(part.shortest(x, y) for part in self.parts)

    def filtered(self, wavelengths, x, y):
        """The sum of the parts, each filtered: the same heights in other parts have the same waves."""
        return Sum(tuple(part.filtered(wavelengths, x, y) for part in self.parts))

    def varies_along(self, direction):
        """Whether a part does."""
        return any(part.varies_along(direction) for part in self.parts)

    @property
    def moving(self):
        """Those of all parts."""
        return tuple(each for part in self.parts for each in part.moving)


@dataclass(frozen=True)
class Smoothed(Surface):
    """A surface through a Gaussian filter, at the nodes of a grid."""

    surface: Surface
    wavelengths: tuple
    """Along x and along y in m: half of such a wave is left."""
    steps: tuple
    """From sample to sample along x and along y, in m."""
    ends: tuple
    """Where samples end along x and along y: beyond, the last one goes on."""

    def height(self, x, y):
        """At nodes (1, nx) and (ny, 1), or (nx, 1) and (1, ny), equally spaced."""
        return smoothed(self.surface.height, x, y, self.wavelengths, self.steps, self.ends)


def summed(parts):
    """One surface of several; None of none."""
    parts = tuple(parts)
    if len(parts) < 2:
        return parts[0] if parts else None
    return Sum(parts)


def step_of(nodes):
    """Distance of the nodes of a line; 0 of a single node."""
    return float(abs(nodes[1] - nodes[0])) if len(nodes) > 1 else 0.0


def ends_of(nodes):
    """Least and largest coordinate of a line of nodes."""
    return float(np.min(nodes)), float(np.max(nodes))
