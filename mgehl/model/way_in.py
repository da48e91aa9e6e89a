"""Reduced pressure that builds up on the way to a contact: Grubin's integral, by the length of the way."""

from dataclasses import dataclass
from functools import cached_property
from math import exp, log

import numpy as np

STEPS = np.geomspace(1e-6, 1e5, 500)
"""Lengths of the way, in semi-axes of the contact, at which the integral is known."""


@dataclass(frozen=True)
class WayIn:
    """A straight way to the edge of a contact."""

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
