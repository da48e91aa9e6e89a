"""The rigid fixed wedge bearing, with a pillar, a pocket or a blocked exit in its film  [Liu eqs. 43, 44].

Inside the code X = x/mm, H = h/(m mm) = |X|, P = m^2 p/(eta u) per mm and d/dX(H^3 dP/dX) + d/dY(H^3 dP/dY)
= +-6 dH/dX. Of a pad that is described by its films the smaller of these stands for m mm.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.model.frame import Frame
from mgehl.model.lubricant import ConstantDensity, ConstantViscosity, Lubricant

MM = 1e-3
"""Metres per unit of X and Y."""

ON_EDGE = 1e-9
"""A node this close to a pillar's edge, in mm, is on it, and solid; so is a pocket's edge on the pad's."""

SHORTEST = 1e-3
"""Part of the way from node to node that one to an edge takes at the least."""


def _square(X, Y, size):
    return np.maximum(np.abs(X), np.abs(Y)) <= 0.5 * size + ON_EDGE


def _cylinder(X, Y, size):
    return np.hypot(X, Y) <= 0.5 * size + ON_EDGE


def _none(X, Y, _size):
    return np.zeros(np.broadcast(X, Y).shape, dtype=bool)


PILLARS = {"none": _none, "square": _square, "cylinder": _cylinder}
"""Cross sections: True inside, X and Y counted from the centre."""


@dataclass(frozen=True)
class Pocket:
    """A recess of the pad with an even bottom; lengths in metres, along X and Y as the bearing's."""

    depth: float
    along: tuple[float, float]
    """Where it begins and ends along x."""
    width: float
    """Across the motion, its middle at y = 0."""

    def shares(self, X, Y, dX, dY, pad):
        """The parts along X and along Y of the cells dX by dY around X (1, nx) and Y (lines, 1), in mm,
        that it lies over.

        Where it reaches the edge of the `pad`, ends (along, across) in m, it goes on beyond: a cell there
        lies half outside, and what enters or leaves does so by the whole of its depth.
        """
        across = -0.5 * self.width, 0.5 * self.width
        return [
            _covered(at, cell, *_beyond(own, edges))
            for at, cell, own, edges in zip((X, Y), (dX, dY), (self.along, across), pad, strict=True)
        ]


def _beyond(ends, edges):
    """The ends of a pocket in mm, those at or beyond the pad's `edges` at infinity."""
    first, last = ends[0] / MM, ends[1] / MM
    return (
        -np.inf if first <= edges[0] / MM + ON_EDGE else first,
        np.inf if last >= edges[1] / MM - ON_EDGE else last,
    )


def _covered(X, cell, first, last):
    """The part of cells around X that lies between `first` and `last`."""
    below, above = X - 0.5 * cell, X + 0.5 * cell
    return np.clip(np.minimum(above, last) - np.maximum(below, first), 0.0, cell) / cell


@dataclass(frozen=True)
class WedgeBearing:
    """A plane pad of gap h = level + slope x over a plate that drags the film from `inlet` to `exit`.

    Lengths in metres, x counted from where the gap is `level`: without one, from where pad and plate would
    meet. `turned` by 180 degrees about the vertical axis, it lies at negative X; its plate, of `speed`,
    moves to +X.
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
    level: float = 0.0
    pocket: Pocket | None = None
    ambient_pressure: float = 0.0
    """In Pa, at the pad's edges; where the film tears the pressure is 0."""
    closed_sides: bool = False
    """Whether there are walls at the sides."""
    laws: Lubricant | None = None
    """None: constant viscosity and density."""

    is_loaded = False
    is_at_rest = False
    is_mixed = is_rough = False
    roughness = 0.0
    """The gap is given."""
    thinning = None
    tears_at = 0.0
    """Its P counts from there, and is the ambient one around the pad."""
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
        """Constant in density and viscosity, unless there are `laws`."""
        return self.laws or Lubricant(ConstantViscosity(self.viscosity), ConstantDensity())

    @property
    def films(self):
        """The gap at the exit and at the inlet, in m, without a pocket."""
        return self.level + self.slope * self.exit, self.level + self.slope * self.inlet

    def cell_area(self, mesh):
        """Area of a cell of a mesh in m^2; of a line of nodes all across."""
        return mesh.dX * self.x_scale * (self.width if mesh.is_line else mesh.dY * self.y_scale)

    @property
    def _unit_slope(self):
        """Metres of film per unit of H and mm of X: m of [Liu eq. 44]."""
        return min(self.films) / MM if self.level else self.slope

    @property
    def pressure_scale(self):
        """Pascals per unit of P  [Liu eq. 44]."""
        return self.viscosity * self.speed / (self._unit_slope**2 * MM)

    @property
    def film_scale(self):
        """Metres of film per unit of H."""
        return self._unit_slope * MM

    @property
    def ambient(self):
        """P at the pad's edges."""
        return self.ambient_pressure / self.pressure_scale

    @property
    def is_line(self):
        """Whether nothing varies across the motion."""
        whole = self.pocket is None or self.pocket.width >= self.width
        return self.closed_sides and whole and self.pillar == "none"

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
        """H of the pad at the coordinates X, also where a pillar stands, and without a pocket."""
        if not self.level:
            return np.abs(X)
        return (self.level + self.slope * MM * self._against(X)) / self.film_scale

    def mean_gap(self, X, Y, dX, dY):
        """H with its pocket: the mean over the cells dX by dY around X (1, nx) and Y (lines, 1)."""
        if self.pocket is None:
            return self.gap(X)
        along, across = self._shares(X, Y, dX, dY)
        return self.gap(X) + self._depth * (along * across)

    def gap_between(self, X, Y, dX, dY, along):
        """What a gap with a pocket carries and what is its cube, exact between nodes dX or dY apart
        (`mgehl.discretization.face_gap`): those whose faces, in the middle, are at X and Y, `along` X or
        not. Parts of a face beside each other are parallel, parts of the way one behind the other."""
        share_x, share_y = self._shares(X, Y, dX, dY)
        way, beside = (share_x, share_y) if along else (share_y, share_x)
        pad = self.gap(X) + 0.0 * Y
        deep = pad + self._depth
        cubed = 1.0 / ((1.0 - way) / pad**3 + way / deep**3)
        carried = cubed * ((1.0 - way) / pad**2 + way / deep**2)
        return pad + beside * (carried - pad), pad**3 + beside * (cubed - pad**3)

    def gap_to_edge(self, X, Y, dX, dY):
        """The faces along X that an edge lies beside, and the same of the way to it from the node that the
        plate comes from."""
        (way, beside), before = self._shares(X, Y, dX, dY), X - 0.5 * dX * self.motion[0]
        pad, is_deep = self.gap(X) + 0.0 * Y, self._shares(before, Y, ON_EDGE, dY)[0] > 0.5
        gap, part = pad + is_deep * self._depth, np.where(is_deep, way, 1.0 - way)
        has_edge = (way > 0.0) & (way < 1.0) & (beside > 0.0)
        cubed = gap**3 / np.maximum(part, SHORTEST)
        return has_edge, pad + beside * (gap - pad), pad**3 + beside * (cubed - pad**3)

    @property
    def _depth(self):
        """Of the pocket, in units of H."""
        return self.pocket.depth / self.film_scale

    def _shares(self, X, Y, dX, dY):
        pad = (self.exit, self.inlet), (-0.5 * self.width, 0.5 * self.width)
        return self.pocket.shares(self._against(X), Y, dX, dY, pad)

    def solid(self, X, Y):
        """True where pad and plate are in contact; X (1, nx) and Y (lines, 1) or such."""
        X, Y = self._against(X), self._against(Y)
        inside = PILLARS[self.pillar](X - self.pillar_x / MM, Y - self.pillar_y / MM, self.pillar_size / MM)
        if self.blocked_exit:
            inside = inside | (X < self.exit / MM)
        return inside

    def _against(self, X):
        """Coordinates of the bearing that is not turned: its X goes against the motion."""
        return X if not self.turned else -X
