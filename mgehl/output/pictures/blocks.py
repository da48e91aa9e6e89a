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
