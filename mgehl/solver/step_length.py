"""How much of a Newton step is taken: no pressure and no film may change by too much at once."""

import numpy as np

from mgehl.discretization.status import LUBRICATED
from mgehl.solver.squeeze import share_of_the_gap

LARGEST_CHANGE, MOST_OF_A_NODE = 0.5, 20.0
"""Mean change of a film by a step, over itself, where it closes continuously, and what a node counts at the
most. A valley that a step empties lifts the bodies by several films: a ball of 136 nm rms at 0.03 mm/s does
not settle in 60 steps with a mean of 1 or of 0.2, nor without a limit."""

STEEP, MOST_MORE = 19.0, 2.0
"""alpha p_h below which a step may change pressures by more, in proportion: a longer step goes wrong
because the viscosity does not follow its tangent. A pressure spike grows from grid to grid by p_h and
more, which takes many short steps: M = 20, L = 10 (alpha p_h = 10) on 1025 nodes by 3B and the arithmetic
mean 17 without this, 12 with it. With 15 to 20 as many within two; with alpha p_h from 20 on longer steps
do harm as often as good. `MOST_MORE` is how many times as much at the most: a longer step closes the film
of soft bodies, and they do not part again (without it 32 of 92 in `study soft` did not converge)."""

SMALLEST = 1e-300
"""So that nothing is divided by zero."""


def step_length(problem, partition, evaluation, state, dP, dH0, max_pressure_step):
    """Part of the step -dP (lines, nx), -dH0 from an evaluated state, at most 1 (collective).

    And the gap that it leads to, (lines, nx), and what the gap falls by in a whole step; None where that is
    not known.
    """
    largest = problem.grid.max(np.abs(dP), initial=0.0)
    limit = max_pressure_step * _more(problem.contact) * _scale(problem, state)
    length = min(1.0, limit / max(largest, SMALLEST))
    if not problem.scheme.contact_law.is_continuous:
        return length, None, None
    P = state.P - length * dP
    P[np.logical_or(*partition.tension(P, state.status))] = 0.0
    H = problem.gap(P, state.H0 - length * dH0)
    allowed = LARGEST_CHANGE / max(mean_change(problem, evaluation, state, H), SMALLEST)
    dH = (state.H - H) / length
    return (length, H, dH) if allowed >= 1.0 else (length * allowed, None, dH)


def _scale(problem, state):
    """Pressure beside which a step is long: p_h, or the largest one on the peaks of rough bodies.

    It may be several p_h. Of 37 rough contacts (257 nodes) six take a third to two thirds less work by it,
    one 2 % more.
    """
    if not problem.contact.roughness:
        return 1.0
    return max(1.0, problem.grid.max(state.P, initial=0.0))


def _more(contact):
    """How many times as much pressures may change as where the viscosity is steep; at least 1.

    Of rough bodies it is 1: their largest pressure is scale enough. A ball of 294 nm rms at 0.64 m/s and
    22 N does not settle on 257 nodes with more.
    """
    if contact.roughness:
        return 1.0
    alpha_bar = contact.lubricant.pressure_viscosity * contact.pressure_scale
    return min(max(1.0, STEEP / max(alpha_bar, SMALLEST)), MOST_MORE)


def mean_change(problem, evaluation, state, H):
    """Mean change of the film over itself on the way to a gap H, (lines, nx).

    Deep valleys do not count: their gap says nothing of the film beside them.
    """
    is_thin = share_of_the_gap(problem, evaluation) > 0.5
    film = is_thin & (state.status == LUBRICATED) & (state.H > problem.scheme.contact_law.contact_gap)
    change = np.abs(H - state.H)[film] / state.H[film]
    total = problem.grid.sum(np.minimum(change, MOST_OF_A_NODE).sum())
    return total / max(problem.grid.count(film), 1)
