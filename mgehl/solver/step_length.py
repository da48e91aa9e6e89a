"""How much of a Newton step is taken: no pressure and no film may change by too much at once."""

import numpy as np

from mgehl.discretization.status import LUBRICATED
from mgehl.solver.squeeze import share_of_the_gap

LARGEST_CHANGE, MOST_OF_A_NODE = 0.5, 20.0
"""Mean change of a film by a step, over itself, where it closes continuously, and what a node counts at the
most. A valley that a step empties lifts the bodies by several films: a ball of 136 nm rms at 0.03 mm/s does
not settle in 60 steps with a mean of 1 or of 0.2, nor without a limit."""

SMALLEST = 1e-300
"""So that nothing is divided by zero."""


def step_length(problem, evaluation, state, dP, dH0, max_pressure_step):
    """Part of the step -dP (lines, nx), -dH0 from an evaluated state, at most 1 (collective)."""
    largest = problem.grid.max(np.abs(dP), initial=0.0)
    length = min(1.0, max_pressure_step / max(largest, SMALLEST))
    if problem.scheme.contact_law.is_continuous:
        length = min(length, longest_for_the_film(problem, evaluation, state, dP, dH0))
    return length


def longest_for_the_film(problem, evaluation, state, dP, dH0):
    """Part of a step that changes the mean film by `LARGEST_CHANGE` of itself; a convolution.

    Deep valleys do not count: their gap says nothing of the film beside them.
    """
    is_thin = share_of_the_gap(problem, evaluation) > 0.5
    film = is_thin & (state.status == LUBRICATED) & (state.H > problem.scheme.contact_law.contact_gap)
    change = np.abs(problem.deflection(dP) + dH0)[film] / state.H[film]
    total = problem.grid.sum(np.minimum(change, MOST_OF_A_NODE).sum())
    return LARGEST_CHANGE * max(problem.grid.count(film), 1) / max(total, SMALLEST)
