"""What is on the bodies of a contact: its heights, how rough they are, and what of them a grid can show."""

from dataclasses import replace
from functools import cached_property

import numpy as np

from mgehl.model.surface.surface import JUST, step_of

SAMPLES = 65
"""Heights along each side from which the roughness is reckoned: the same whatever the grid."""
STEP = 1e-3
"""Part of the semi-axes over which slopes are taken."""
NEXT_TO_NONE = 1e-18
"""Roughness in m that is none: a dent far beside the contact leaves a tail in it."""
SHOWN_CELLS = 4.0
"""Cells of a coarse grid in the shortest wave that it is shown."""


class OnBodies:
    """The heights of a contact that adds its scales and `smooth_gap`."""

    surface = None
    """The `Surface` of the body that stands still: a peak is positive and lowers the gap."""

    def undeformed_gap(self, X, Y):
        """Gap of the undeformed bodies in units of H, whatever is on their surface."""
        smooth = self.smooth_gap(X, Y)
        if self.surface is None:
            return smooth
        return smooth - self.surface.height(X * self.x_scale, Y * self.y_scale) / self.film_scale

    @property
    def roughness(self):
        """Rms of the heights within the Hertz semi-axes, about their mean, in m; 0 of smooth bodies."""
        return float(np.sqrt(np.mean(self.heights**2)))

    @property
    def skewness(self):
        """Ssk of the same heights: positive where there are more peaks than valleys; 0 of smooth bodies."""
        rms = self.roughness
        return float(np.mean((self.heights / rms) ** 3)) if rms else 0.0

    @property
    def slope(self):
        """Rms slope of the surface where the heights are taken; 0 of smooth bodies."""
        if self.surface is None:
            return 0.0
        x, y = self._places
        dx, dy = STEP * self.x_scale, STEP * self.y_scale
        squares = [np.mean(self._rise(x + dx, x - dx, y, y) ** 2) / (2.0 * dx) ** 2]
        if not self.is_plane:
            squares.append(np.mean(self._rise(x, x, y + dy, y - dy) ** 2) / (2.0 * dy) ** 2)
        return float(np.sqrt(sum(squares)))

    def _rise(self, x, x_before, y, y_before):
        return self.surface.height(x, y) - self.surface.height(x_before, y_before)

    @property
    def is_rough(self):
        """Whether there are heights, in the contact or beside it: in time they may come into it."""
        return self.surface is not None

    @property
    def mean_height(self):
        """Mean of the heights within the Hertz semi-axes, in m; 0 of smooth bodies."""
        return float(self._samples.mean())

    @property
    def heights(self):
        """Samples of the heights within the Hertz semi-axes, about their mean, in m."""
        return self._samples - self._samples.mean()

    @cached_property
    def _samples(self):
        if self.surface is None:
            return np.zeros(1)
        x, y = self._places
        return np.broadcast_to(self.surface.height(x, y), (len(y), SAMPLES))

    @property
    def _places(self):
        """x (1, nx) and y (ny, 1) of the samples in m."""
        side = np.linspace(-1.0, 1.0, SAMPLES)
        across = np.zeros(1) if self.is_plane else side
        return side[None, :] * self.x_scale, across[:, None] * self.y_scale

    def shortest_wave(self, mesh):
        """Shortest wavelength of the surface in m, as seen on a mesh within the Hertz semi-axes."""
        x, y = self._nodes(mesh)
        inside = np.abs(x) <= self.x_scale, np.abs(y) <= self.y_scale
        return self.surface.shortest(x[inside[0]], y[inside[1]])

    def longest_cell(self, mesh):
        """The longer side of a mesh's cell, in m."""
        return max(map(step_of, self._nodes(mesh)))

    def seen_by(self, mesh, finest):
        """The contact as a coarser `mesh` than the `finest` sees it: no waves shorter than `SHOWN_CELLS`. A
        surface that has none is left as it is, to the last bit."""
        if self.surface is None:
            return self
        x, y = self._nodes(finest)
        cells = [step_of(nodes) for nodes in self._nodes(mesh)]
        wavelengths = tuple(SHOWN_CELLS * cell for cell in cells)
        if mesh.nx == finest.nx or self.shortest_wave(finest) >= (1.0 - JUST) * max(wavelengths):
            return self
        return replace(self, surface=self.surface.filtered(wavelengths, x, y))

    def _nodes(self, mesh):
        """Lines of a mesh's nodes along x and along y, in m."""
        return mesh.X * self.x_scale, mesh.Y * self.y_scale
