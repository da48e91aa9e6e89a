"""Uniform node-centred mesh in the contact's units X = x/a, Y = y/b."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np


@dataclass(frozen=True)
class Mesh:
    """`nx` by `ny` nodes on [x[0], x[1]] by [y[0], y[1]], outermost nodes on the boundary."""

    nx: int
    ny: int
    x: tuple[float, float]
    y: tuple[float, float]
    k_e: float = 1.0
    """Axis ratio a/b of the units of X and Y."""

    @property
    def dX(self):
        return (self.x[1] - self.x[0]) / (self.nx - 1)

    @property
    def dY(self):
        return (self.y[1] - self.y[0]) / (self.ny - 1)

    @property
    def nodes(self):
        return self.nx * self.ny

    @cached_property
    def X(self):
        """Node coordinates along X, shape (nx,)."""
        return np.linspace(*self.x, self.nx)

    @cached_property
    def Y(self):
        """Node coordinates along Y, shape (ny,)."""
        return np.linspace(*self.y, self.ny)

    def coarsened(self):
        """The mesh of every other node."""
        return Mesh((self.nx + 1) // 2, (self.ny + 1) // 2, self.x, self.y, self.k_e)

    def nearest(self, X, Y):
        """Indices (i, j) of the node nearest to a point."""
        return int(np.abs(self.X - X).argmin()), int(np.abs(self.Y - Y).argmin())
