"""How much of a Newton step is taken: no pressure and no film may change by too much at once."""

import numpy as np

from mgehl.discretization.status import LUBRICATED
from mgehl.solver.squeeze import share_of_the_gap

LARGEST_CHANGE, MOST_OF_A_NODE = 0.5, 20.0
"""Mean change of a film by a step, over itself, where it closes continuously, and what a node counts at the
most: an emptied valley lifts bodies by several films. With 1, with 0.2 and without, thin films fail."""

SMALLEST = 1e-300
"""So that nothing is divided by zero."""


def step_length(problem, partition, evaluation, state, dP, dH0, settings, in_turn=False):
    """Part of the step -dP (lines, nx), -dH0 from an evaluated state, at most 1, by `NewtonSettings`; the
    gap that it leads to, and what the gap falls by in a whole step, or None (collective). With `in_turn` so
    does the `Partition` change."""
    # A film falls to the pressure at which it tears and no further, whatever a step asks for.
    room = np.where(state.status == LUBRICATED, state.P - problem.contact.tears_at, np.inf)
    largest = problem.grid.max(np.abs(np.minimum(dP, room)), initial=0.0)
    limit = settings.max_pressure_step
    if settings.over_largest:
        limit *= max(1.0, problem.grid.max(state.P, initial=0.0))
    length = min(1.0, limit / max(largest, SMALLEST))
    if not settings.by_film:
        return length, None, None
    P = state.P - length * dP
    P[np.logical_or(*partition.tension(P, state.status, in_turn))] = problem.contact.tears_at
    H = problem.gap(P, state.H0 - length * dH0)
    allowed = LARGEST_CHANGE / max(mean_change(problem, evaluation, state, H), SMALLEST)
    dH = (state.H - H) / length
    return (length, H, dH) if allowed >= 1.0 else (length * allowed, None, dH)


def mean_change(problem, evaluation, state, H):
    """Mean change of the film over itself on the way to a gap H, (lines, nx). Deep valleys do not count:
    their gap says nothing of the film beside them."""
    is_thin = share_of_the_gap(problem, evaluation) > 0.5
    film = is_thin & (state.status == LUBRICATED) & (state.H > problem.scheme.contact_law.contact_gap)
    change = np.abs(H - state.H)[film] / state.H[film]
    total = problem.grid.sum(np.minimum(change, MOST_OF_A_NODE).sum())
    return total / max(problem.grid.count(film), 1)
