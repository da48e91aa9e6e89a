"""What of a file's points is no height: holes, and what looks like an error or a missing value."""

from dataclasses import dataclass

import numpy as np
from scipy import ndimage, sparse
from scipy.sparse.linalg import spsolve

MOST_HOLES = 0.25
"""Part of the points that may be filled: what is filled is smooth."""

BEYOND = 4.0
"""Times a large step between neighbours by which a point that stands out lies beyond all of its own."""

LARGE = 99.0
"""Per cent of the steps that are smaller than a large one."""

MOST_LINES = 90.0
"""Per cent of the lines whose steps are usual."""

FAR, SEVERAL = 0.25, 3
"""Distance of a height from all others, over the spread of these, from which on it is hardly one that so
many points share."""

STEEP = 0.02
"""A lower one, over the distance of its neighbours, is no matter: a wave of such bears 2 GPa on steel."""

_RING = np.array([[1, 1, 1], [1, 0, 1], [1, 1, 1]], dtype=bool)


@dataclass(frozen=True)
class Point:
    """A point of a file, counted from 1, and a height in m."""

    row: int
    column: int
    height: float


def harmonic(z, dx, dy):
    """Heights (ny, nx) with their holes filled by Laplace's equation; at the edge the slope is zero."""
    hole = ~np.isfinite(z)
    number = np.cumsum(hole.ravel()).reshape(z.shape) - 1
    count, known = int(hole.sum()), np.where(hole, 0.0, z)
    rows, columns, values, right = [], [], [], np.zeros(count)
    for axis, weight in ((0, dy**-2.0), (1, dx**-2.0)):
        ahead = [slice(None)] * 2
        behind = list(ahead)
        ahead[axis], behind[axis] = slice(1, None), slice(None, -1)
        for here, there in ((tuple(ahead), tuple(behind)), (tuple(behind), tuple(ahead))):
            at, beside = hole[here], hole[there]
            rows += [number[here][at], number[here][at & beside]]
            columns += [number[here][at], number[there][at & beside]]
            values += [np.full(at.sum(), weight), np.full((at & beside).sum(), -weight)]
            np.add.at(right, number[here][at], weight * known[there][at])
    indices = np.concatenate(rows), np.concatenate(columns)
    matrix = sparse.csc_matrix((np.concatenate(values), indices), shape=(count, count))
    filled = np.array(z, dtype=float)
    filled[hole] = spsolve(matrix, right, permc_spec="MMD_AT_PLUS_A")
    return filled


def farthest(z):
    """The `Point` whose height is farthest from the median, and by how much."""
    off = z - np.median(z)
    return _point(off, np.abs(off).argmax())


def outstanding(z, step):
    """Number of points that stand out of all eight neighbours, and the `Point` that does most. Form and
    tilt are no matter, and few such points do not change what a usual step is."""
    least = ndimage.minimum_filter(z, footprint=_RING, mode="constant", cval=np.inf)
    most = ndimage.maximum_filter(z, footprint=_RING, mode="constant", cval=-np.inf)
    over = z - np.clip(z, least, most)
    usual = np.percentile(np.abs(np.concatenate([np.diff(z, axis=k).ravel() for k in (0, 1)])), LARGE)
    found = np.abs(over) > max(BEYOND * usual, STEEP * step)
    return int(found.sum()), _point(over, np.abs(over).argmax())


def jumped(z):
    """("row" or "column", numbers, m) of lines of points that lie as a whole above or below both of their
    neighbours by far more than lines usually differ, as an instrument's scan lines do, and the most of them
    in m. Many such lines are a texture: none is told."""
    for lines, name in ((z, "row"), (z.T, "column")):
        steps = np.diff(np.median(lines, axis=1))
        apart = np.where(steps[:-1] * steps[1:] < 0.0, np.minimum(*np.abs((steps[:-1], steps[1:]))), 0.0)
        usual = np.percentile(np.abs(steps), MOST_LINES) if steps.size > 1 else 0.0
        found = np.flatnonzero(apart > BEYOND * usual)
        if 0 < found.size <= SEVERAL and usual:
            return name, [int(line) + 2 for line in found], float(apart.max())
    return "", [], 0.0


def repeated(z):
    """Number of points that share the least or the largest height, and the first `Point`, where this height
    is far from all others; 0, None where neither is. A hole is no height.
    """
    known = z[np.isfinite(z)]
    for off in (z - known.min(), known.max() - z):
        others = off[off > 0.0]
        count, spread = known.size - others.size, np.ptp(others) if others.size else 0.0
        far = spread if count < SEVERAL else FAR * spread
        if count > 1 and 0.0 < far < others.min():
            return count, _point(z, np.nanargmin(off))
    return 0, None


def _point(z, index):
    row, column = np.unravel_index(index, z.shape)
    return Point(int(row) + 1, int(column) + 1, float(z[row, column]))
