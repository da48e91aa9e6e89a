"""Contents of less than nothing are paid for by the nodes around: none is made.

The residual of a step in time is carried on as content. In contact or an empty cavity that may be less than
nothing, which no pressure of the next step could make up for.
"""

import numpy as np

MOST = 0.25
"""Part of what its neighbours hold that a node takes in a round: it has four, and they four others."""

ROUNDS = 50
"""Rounds at the most. What is owed then, within wide contact, is paid by all nodes: 1e-8 of the oil."""


def paid(problem, m):
    """Contents (lines, nx) with the same sum, none below nothing; not of the boundary (collective)."""
    for _ in range(ROUNDS):
        owed = np.where(problem.boundary, 0.0, np.maximum(-m, 0.0))
        if not problem.grid.count(owed > 0.0):
            break
        m = m + _payments(problem, owed, np.where(problem.boundary, 0.0, np.maximum(m, 0.0)))
    return _shared(problem, m)


def _shared(problem, m):
    """What is still owed, paid by all nodes in proportion to what they hold."""
    inner = np.where(problem.boundary, 0.0, m)
    owed, held = (problem.grid.sum(np.maximum(each, 0.0).sum()) for each in (-inner, inner))
    if owed == 0.0 or held <= owed:
        return m
    return np.where(problem.boundary, m, np.maximum(m, 0.0) * (1.0 - owed / held))


def _payments(problem, owed, held):
    """What each node is given by those around it, in proportion to what they hold, less what it gives to
    others: (lines, nx)."""
    halo, around, given = problem.grid.halo, np.zeros(owed.shape), np.zeros(owed.shape)
    ghosted = halo(held)
    for axis in problem.axes:
        axis.add_entering(axis.at(ghosted, 0) * axis.cell, around)
        axis.subtract_leaving(-axis.at(ghosted, 1) * axis.cell, around)
    share = np.divide(owed, around, out=np.zeros(owed.shape), where=around > 0.0)
    share = halo(np.minimum(share, MOST))
    for axis in problem.axes:
        along = axis.at(share, 1) * axis.at(ghosted, 0) - axis.at(share, 0) * axis.at(ghosted, 1)
        axis.add_entering(along * axis.cell, given)
        axis.subtract_leaving(along * axis.cell, given)
    return given
