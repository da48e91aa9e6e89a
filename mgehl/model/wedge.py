"""The rigid fixed wedge bearing, with a pillar or a blocked exit in its film  [Liu eqs. 43, 44].

Lengths are in millimetres inside the code: X = x/mm, the gap is H = h/(m mm) = |X|, and with
P = m^2 p/(eta u) per mm the equation is d/dX(H^3 dP/dX) + d/dY(H^3 dP/dY) = +-6 dH/dX.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.model.frame import Frame
from mgehl.model.lubricant import ConstantDensity, ConstantViscosity, Lubricant

MM = 1e-3
"""Metres per unit of X and Y."""

ON_EDGE = 1e-9
"""A node this close to a pillar's edge, in mm, is on it, and solid."""


def _square(X, Y, size):
    return np.maximum(np.abs(X), np.abs(Y)) <= 0.5 * size + ON_EDGE


def _cylinder(X, Y, size):
    return np.hypot(X, Y) <= 0.5 * size + ON_EDGE


def _none(X, Y, _size):
    return np.zeros(np.broadcast(X, Y).shape, dtype=bool)


PILLARS = {"none": _none, "square": _square, "cylinder": _cylinder}
"""Cross sections: True inside, X and Y counted from the centre."""


@dataclass(frozen=True)
class WedgeBearing:
    """A plane pad of gap h = slope x over a plate that drags the film from `inlet` to `exit`.

    Lengths in metres, x counted from the line where pad and plate would meet. The plate moves
    towards -X; `turned` by 180 degrees about the vertical axis, the bearing lies at negative X and
    its plate moves towards +X.
    """

    exit: float
    inlet: float
    width: float
    slope: float
    viscosity: float
    speed: float
    turned: bool = False
    blocked_exit: bool = False
    pillar: str = "none"
    pillar_x: float = 0.0
    pillar_y: float = 0.0
    pillar_size: float = 0.0

    is_loaded = False
    is_at_rest = False
    is_mixed = is_soft = False
    roughness = 0.0
    """The gap is given."""
    lambda_ = 6.0
    """Reynolds coefficient of d(H^3 dP/dX)/dX = 6 dH/dX."""
    x_scale = y_scale = MM
    k_e = 1.0
    frame = Frame()

    def in_frame(self, frame):
        """Itself: a bearing is solved in the user's axes."""
        return self

    @property
    def motion(self):
        """The plate's velocity along X and Y, in units of its speed."""
        return (1.0 if self.turned else -1.0, 0.0)

    @property
    def lubricant(self):
        """Constant in density and viscosity."""
        return Lubricant(ConstantViscosity(self.viscosity), ConstantDensity())

    @property
    def pressure_scale(self):
        """Pascals per unit of P  [Liu eq. 44]."""
        return self.viscosity * self.speed / (self.slope**2 * MM)

    @property
    def film_scale(self):
        """Metres of film per unit of H."""
        return self.slope * MM

    def placement(self, nodes):
        """First and last X of `nodes` nodes, and the two edges of the pad between them.

        The first node from the exit lies half a cell outside, so that a face of the mesh, and not
        a node, is at the exit  [Liu sec. 4.1].
        """
        exit, inlet = self.exit / MM, self.inlet / MM
        first = exit - 0.5 * (inlet - exit) / (nodes - 1.5)
        if self.turned:
            return (-inlet, -first), (-inlet, -exit)
        return (first, inlet), (exit, inlet)

    def gap(self, X):
        """H at the coordinates X; that of the pad also where a pillar stands."""
        return np.abs(X)

    def solid(self, X, Y):
        """True where pad and plate are in contact; X (1, nx) and Y (lines, 1) or such."""
        side = 1.0 if not self.turned else -1.0
        inside = PILLARS[self.pillar](
            side * X - self.pillar_x / MM, side * Y - self.pillar_y / MM, self.pillar_size / MM
        )
        if self.blocked_exit:
            inside = inside | (side * X < self.exit / MM)
        return inside
