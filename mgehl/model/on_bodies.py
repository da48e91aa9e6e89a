"""What is on the bodies of a contact: its heights, how rough they are, and what of them a grid can show."""

from dataclasses import replace
from functools import cached_property

import numpy as np

from mgehl.model.surface.surface import JUST, step_of

SAMPLES, MOST_SAMPLES, MOST_OF_A_LINE = 65, 513, 4097
"""Heights along each axis of the ellipse from which the roughness is reckoned, whatever the grid; and up to
how many where waves are short, of a line contact the last."""
FEWEST = 3.0
"""Samples in the shortest wave: by two, all of them may be peaks of a regular one."""
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
        """Rms of the heights within the Hertz ellipse, about their mean, in m; 0 of smooth bodies."""
        rms = float(np.std(self._samples))
        return rms if rms > NEXT_TO_NONE else 0.0

    @property
    def skewness(self):
        """Ssk of the same heights: positive where there are more peaks than valleys; 0 of smooth bodies."""
        rms = self.roughness
        return float(np.mean(((self._samples - self.mean_height) / rms) ** 3)) if rms else 0.0

    @property
    def slope(self):
        """Rms slope of the surface where the heights are taken; 0 of smooth bodies."""
        if self.surface is None:
            return 0.0
        dx, dy = STEP * self.x_scale, STEP * self.y_scale
        squares = np.mean((self._sampled(dx, 0.0) - self._sampled(-dx, 0.0)) ** 2) / (2.0 * dx) ** 2
        if not self.is_line:
            squares += np.mean((self._sampled(0.0, dy) - self._sampled(0.0, -dy)) ** 2) / (2.0 * dy) ** 2
        return float(np.sqrt(squares))

    @property
    def is_rough(self):
        """Whether there are heights, in the contact or beside it: in time they may come into it."""
        return self.surface is not None

    @property
    def mean_height(self):
        """Mean of the heights within the Hertz ellipse, in m; 0 of smooth bodies."""
        return float(self._samples.mean())

    @property
    def heights(self):
        """Heights at the same places X and Y within the Hertz ellipse of any contact, about their mean, in
        m, (n,)."""
        found = self._samples if self._samples_a_side == SAMPLES else self._sampled(0.0, 0.0, SAMPLES)
        return found - found.mean()

    @cached_property
    def _samples(self):
        return self._sampled(0.0, 0.0)

    @cached_property
    def _samples_a_side(self):
        """So many that the shortest wave has `FEWEST`."""
        if self.surface is None:
            return SAMPLES
        found, most = SAMPLES, MOST_OF_A_LINE if self.is_line else MOST_SAMPLES
        X = np.linspace(-1.0, 1.0, most)
        x, y = X * self.x_scale, np.zeros(1) if self.is_line else X * self.y_scale
        shortest, finest = self.surface.shortest(x, y), max(step_of(x), step_of(y))
        while found < most and finest * (most - 1) / (found - 1) > shortest / FEWEST:
            found = 2 * found - 1
        return found

    def _sampled(self, dx, dy, samples=None):
        """Heights so far, in m, beside the places of the samples, which lie within the Hertz ellipse."""
        if self.surface is None:
            return np.zeros(1)
        X = np.linspace(-1.0, 1.0, samples or self._samples_a_side)[None, :]
        Y = np.zeros((1, 1)) if self.is_line else X.T
        heights = self.surface.height(X * self.x_scale + dx, Y * self.y_scale + dy)
        inside = X**2 + Y**2 <= 1.0
        return np.broadcast_to(heights, inside.shape)[inside]

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
