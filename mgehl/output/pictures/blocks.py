"""Large grids for pictures: blocks of nodes drawn as one, so that nothing that matters is lost."""

from math import ceil

import numpy as np

MOST = 700
"""Nodes or blocks along a side that a map of its own shows: about as many as it has dots."""


class Blocks:
    """Equal blocks of the nodes at X (nx,) and Y (ny,), at most `most` along either side.

    A block is drawn as the least or the largest of its nodes: of the film the least, of pressure and status
    the largest, for contact is above cavitated and that above lubricated. So single nodes in contact stay.
    """

    def __init__(self, X, Y, most=MOST):
        self._stride = ceil(max(len(X), len(Y)) / most)
        self.X, self.Y = (
            self._reduced(np.add, line) / self._reduced(np.add, 1.0 + 0.0 * line) for line in (X, Y)
        )
        self.extent = *self._ends(X), *self._ends(Y)
        """Left, right, lower and upper end of an image; its last blocks may reach beyond the nodes."""

    def least(self, values):
        """The least of each block's values: (ny, nx) to (len(Y), len(X))."""
        return self._reduced(np.minimum, values)

    def largest(self, values):
        """The largest of each block's values: (ny, nx) to (len(Y), len(X))."""
        return self._reduced(np.maximum, values)

    def _reduced(self, extreme, values):
        for axis in range(values.ndim):
            values = extreme.reduceat(values, np.arange(0, values.shape[axis], self._stride), axis=axis)
        return values

    def _ends(self, line):
        """Where the first block of a line of nodes begins, and where the last whole one ends."""
        cell = (line[-1] - line[0]) / (len(line) - 1) if len(line) > 1 else 1.0
        first = float(line[0]) - 0.5 * cell
        return first, first + ceil(len(line) / self._stride) * self._stride * cell
