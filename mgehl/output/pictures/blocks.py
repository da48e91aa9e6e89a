"""Large grids for pictures: blocks of nodes drawn as one, so that nothing that matters is lost."""

from math import ceil

import numpy as np

MOST = 700
"""Nodes or blocks along a side that a map of its own shows: about as many as it has dots."""


class Blocks:
    """Equal blocks of the nodes at X (nx,) and Y (ny,), at most `most` along either side.

    A grid that is small enough has blocks of one node. A block is drawn as the least or the largest of its
    nodes: of the film the least, of the pressure the largest, of the status the largest, too, for contact
    is above cavitated and that above lubricated. So single nodes in contact stay on the map.
    """

    def __init__(self, X, Y, most=MOST):
        stride = ceil(max(len(X), len(Y)) / most)
        self._x, self._y = (np.arange(0, len(line), stride) for line in (X, Y))
        self.X, self.Y = _centres(X, self._x), _centres(Y, self._y)
        self.limits = *_limits(self.X), *_limits(self.Y)
        """Left, right, lower and upper end of the blocks' centres."""
        self.extent = *_edges(X, stride, len(self.X)), *_edges(Y, stride, len(self.Y))
        """The same of the edges of whole blocks: the last ones may reach beyond the nodes."""

    def least(self, values):
        """The least of each block's values: (ny, nx) to (len(Y), len(X))."""
        return self._reduced(np.minimum, values)

    def largest(self, values):
        """The largest of each block's values: (ny, nx) to (len(Y), len(X))."""
        return self._reduced(np.maximum, values)

    def _reduced(self, extreme, values):
        return extreme.reduceat(extreme.reduceat(values, self._y, axis=0), self._x, axis=1)


def _centres(line, starts):
    return np.add.reduceat(line, starts) / np.diff(starts, append=len(line))


def _limits(centres):
    """Where a line of blocks begins and ends; a single one is a unit wide."""
    first, last = float(centres[0]), float(centres[-1])
    return (first, last) if last > first else (first - 0.5, first + 0.5)


def _edges(line, stride, blocks):
    """Where the first block of a line of nodes begins, and where so many whole blocks end."""
    cell = (line[-1] - line[0]) / (len(line) - 1) if len(line) > 1 else 1.0
    first = float(line[0]) - 0.5 * cell
    return first, first + blocks * stride * cell
