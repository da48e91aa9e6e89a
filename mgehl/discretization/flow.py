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

    def close(self, is_open):
        """Nothing passes where `is_open` is False."""
        if is_open.all():
            return
        for array in (self.value, *self.by_P.values(), *self.by_H.values()):
            array *= is_open
