"""Uniform node-centred mesh in the contact's units, X = x/a and Y = y/b for a loaded one."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

HALO = 2
"""Lines of its neighbours, on each side, that a ghosted array carries around a rank's own."""


@dataclass(frozen=True)
class Mesh:
    """`nx` by `ny` nodes on [x[0], x[1]] by [y[0], y[1]], outermost nodes on the boundary. One line (`ny` =
    1) is a plane problem: a slice of unit width between two walls."""

    nx: int
    ny: int
    x: tuple[float, float]
    y: tuple[float, float]
    k_e: float = 1.0
    """Axis ratio a/b of the units of X and Y."""
    edges: tuple[float, float] | None = None
    """Where along X the boundary's pressure acts, if not at the outermost nodes themselves."""

    @property
    def dX(self):
        return (self.x[1] - self.x[0]) / (self.nx - 1)

    @property
    def dY(self):
        return 1.0 if self.is_line else (self.y[1] - self.y[0]) / (self.ny - 1)

    @property
    def is_line(self):
        return self.ny == 1

    @cached_property
    def pressure_dX(self):
        """Distance of the pressures on both sides of each x face: dX, or (nx - 1,) with `edges`."""
        if self.edges is None:
            return self.dX
        distance = np.full(self.nx - 1, self.dX)
        distance[0] = self.X[1] - self.edges[0]
        distance[-1] = self.edges[1] - self.X[-2]
        return distance

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
        return replace(self, nx=(self.nx + 1) // 2, ny=(self.ny + 1) // 2)

    def in_frame(self, frame):
        """The same nodes in a `Frame`."""
        x, y = frame.intervals(self.x, self.y)
        nx, ny = frame.pair(self.nx, self.ny)
        return replace(self, nx=nx, ny=ny, x=x, y=y, k_e=1.0 / self.k_e if frame.exchanged else self.k_e)

    @property
    def centre(self):
        """Indices (i, j) of the node nearest to the centre of the contact."""
        return int(np.abs(self.X).argmin()), int(np.abs(self.Y).argmin())
