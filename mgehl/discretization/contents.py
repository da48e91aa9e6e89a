"""What cavities hold: where it is carried to, and what it must be where nothing behind depends on it.

The surfaces carry it on from node to node. Where film or contact lies further on, the part of the gap that
is filled is an unknown like a pressure. Where only cavities do, it follows from the inflow.
"""

import numpy as np

from mgehl.discretization.compiled import compiled

OVERFULL = 2.0
"""Most of a gap that a marched cavity is said to hold: what holds more than 1 becomes film."""


@compiled()
def feeding(cavity, receives, along_y):
    """Cavities whose content is carried into nodes that receive it, at last; all masks (ny, nx). The
    surfaces move along +X and, where `along_y`, +Y."""
    ny, nx = cavity.shape
    feeds = np.zeros((ny, nx), dtype=np.bool_)
    for j in range(ny - 1, -1, -1):
        for i in range(nx - 2, 0, -1):
            if cavity[j, i]:
                feeds[j, i] = receives[j, i + 1] or feeds[j, i + 1]
                if along_y and j + 1 < ny:
                    feeds[j, i] |= receives[j + 1, i] or feeds[j + 1, i]
    return feeds


def passed_on(gives, takes, axis):
    """The nodes that give, and behind them, along an axis of the arrays, those that take without a gap:
    masks of the nodes, the first a part of the second."""
    number = np.arange(gives.shape[axis]).reshape((-1, 1) if axis == 0 else (1, -1))

    def last(mask):
        return np.maximum.accumulate(np.where(mask, number, -1), axis=axis)

    return takes & (last(gives) > last(~takes))


@compiled()
def missing_fillings(marched, inflow, leaving_x, leaving_y, stored):
    """By how much, `OVERFULL` at most, the fillings of `marched` nodes, a mask, must rise so that their
    `inflow` is nothing; all (ny, nx). Full nodes lose so much along +X and +Y and have `stored` some."""
    ny, nx = marched.shape
    rise = np.zeros((ny, nx))
    for j in range(ny):
        for i in range(1, nx - 1):
            if marched[j, i]:
                gained = inflow[j, i] + leaving_x[j, i - 1] * rise[j, i - 1]
                if j > 0:
                    gained += leaving_y[j - 1, i] * rise[j - 1, i]
                leaving = leaving_x[j, i] + leaving_y[j, i] + stored[j, i]
                if leaving > 0.0 and gained < OVERFULL * leaving:
                    rise[j, i] = gained / leaving
                elif gained > 0.0:
                    rise[j, i] = OVERFULL
    return rise
