"""What the surfaces carry along in a time step: contents go with them, and none is made or lost.

Content m = rho (H - h_b) theta is cut out of the cells that it comes from, each a parabola with the cell's
own mean and no negative value (PPM by Colella and Woodward; Fritsch and Carlson's cubics). A shift by whole
cells is exact; any other of fourth order where the content is smooth.
"""

from dataclasses import dataclass

import numpy as np

STEEPEST = 3.0
"""Content at a face over that of the emptier of its cells: with less, no parabola is negative."""

WEIGHTS = {-2: 2.0, -1: -13.0, 0: 47.0, 1: 27.0, 2: -3.0}
"""Of cells, counted from one towards the face whose content they tell, in sixtieths (Suresh, Huynh 1997).
What both sides of a face tell differs by the fifth difference: a value that is the same for both leaves
waves of two cells as they are in short steps."""


@dataclass(frozen=True)
class Shift:
    """Cells that contents go along X and along Y, positive or negative, with what passes the faces."""

    along_x: float
    along_y: float = 0.0

    def passing_x(self, m):
        """What passes the faces of every line of m (lines, nx): (lines, nx + 1), both ends included."""
        return passing(m, self.along_x)

    def passing_y(self, m):
        """The same along Y, of whole columns (ny, nx): (ny + 1, nx)."""
        return passing(m.T, self.along_y).T


def passing(m, cells):
    """What passes the faces of lines m (..., n) that go `cells` along: (..., n + 1), positive along. Beyond
    the ends the content goes on along a straight line."""
    if cells < 0.0:
        return -passing(m[..., ::-1], -cells)[..., ::-1]
    whole, part = _split(cells)
    room = whole + 3
    beyond = [(0, 0)] * (m.ndim - 1) + [(room, 3)]
    wide = np.maximum(np.pad(m, beyond, mode="reflect", reflect_type="odd"), 0.0)
    wide[..., room:-3] = m
    # Face f of m is face f + room of `wide`; behind it lie `whole` cells, and a part of the next.
    total = np.cumsum(np.pad(wide, [(0, 0)] * (m.ndim - 1) + [(1, 0)]), axis=-1)
    faces = np.arange(room, room + m.shape[-1] + 1)
    found = total[..., faces] - total[..., faces - whole]
    return found + _last_part(wide, faces - whole - 1, part) if part > 0.0 else found


def _split(cells):
    """Whole cells and the part of another one."""
    whole = int(cells)
    part = cells - whole
    return (whole + 1, 0.0) if part > 1.0 - 1e-12 else (whole, part)


def _last_part(m, cells, part):
    """What the last `part` of some cells holds, before their ends along: (..., cells)."""
    here = m[..., cells]
    begin, end = _at_end(m, cells, -1), _at_end(m, cells, 1)
    bulge = 6.0 * here - 3.0 * (begin + end)
    return part * (end - 0.5 * part * (end - begin - (1.0 - 2.0 / 3.0 * part) * bulge))


def _at_end(m, cells, side):
    """Content at the face before some cells (-1) or behind them (1), of fifth order as these cells and two
    neighbours on either side tell it, from nothing to `STEEPEST`."""
    here, beside = m[..., cells], m[..., cells + side]
    value = sum(weight * m[..., cells + side * k] for k, weight in WEIGHTS.items()) / 60.0
    return np.clip(value, 0.0, STEEPEST * np.maximum(np.minimum(beside, here), 0.0))


def moved(values, cells):
    """`values` of faces or nodes (..., n) moved along by `cells`, linearly in them: of third order at
    least, and exact by whole cells. They go on as they end. A difference of flows stays one."""
    if cells < 0.0:
        return moved(values[..., ::-1], -cells)[..., ::-1]
    whole, part = _split(cells)
    n = values.shape[-1]
    wide = np.pad(values, [(0, 0)] * (values.ndim - 1) + [(whole + 2, 1)], mode="edge")
    if part == 0.0:
        return wide[..., 2 : 2 + n]
    # Lagrange's cubic through the nodes two behind, one behind, here and one before, after the whole cells.
    s = -part
    weights = (
        -s * (s * s - 1.0) / 6.0,  # at -2
        s * (s - 1.0) * (s + 2.0) / 2.0,  # at -1
        -(s * s - 1.0) * (s + 2.0) / 2.0,  # at 0
        s * (s + 1.0) * (s + 2.0) / 6.0,  # at +1
    )
    return sum(weight * wide[..., k : k + n] for k, weight in enumerate(weights))


def least_on_the_way(values, cells):
    """The least of `values` at each node (..., n) and at those that contents pass which go `cells` to it,
    one node more included."""
    passed = [float(np.copysign(k, cells)) for k in range(1, int(np.ceil(abs(cells))) + 2)]
    return np.minimum.reduce([values, *(moved(values, each) for each in passed)])
