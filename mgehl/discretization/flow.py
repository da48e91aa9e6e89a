"""What flows through the faces along an axis, and the nodes that it depends on."""

import numpy as np

WW, W, E, EE = 0, 1, 2, 3
"""Node positions relative to the face between W and E, along whichever axis."""

SHIFT = {WW: -1, W: 0, E: 1, EE: 2}
"""How many nodes they lie beyond W."""


class Flow:
    """A flow through the faces along an axis and its derivatives by P and H: `by_P` and `by_H` map node
    positions (WW, W, E, EE) to arrays of the flow's shape."""

    def __init__(self, shape, nodes=()):
        self.value = np.zeros(shape)
        self.by_P = {node: np.zeros(shape) for node in sorted(nodes)}
        self.by_H = {node: np.zeros(shape) for node in sorted(nodes)}

    @property
    def is_linearised(self):
        """Whether it has derivatives."""
        return bool(self.by_P)

    @property
    def _arrays(self):
        return (self.value, *self.by_P.values(), *self.by_H.values())

    def scale(self, factor):
        """Multiply it by a `factor` of each face."""
        for array in self._arrays:
            array *= factor

    def add(self, other):
        """Add another one of the same nodes."""
        for array, part in zip(self._arrays, other._arrays, strict=True):
            array += part

    def replace(self, other, where):
        """Let another one take its place at some faces, a mask."""
        for array, part in zip(self._arrays, other._arrays, strict=True):
            array[where] = part[where]

    def close(self, is_open):
        """Nothing passes where `is_open` is False."""
        if is_open.all():
            return
        self.scale(is_open)
