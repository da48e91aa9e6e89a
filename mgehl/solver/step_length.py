"""How much of a Newton step is taken: no pressure and no film may change by too much at once."""

from typing import NamedTuple

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.status import LUBRICATED
from mgehl.solver.squeeze import share_of_the_gap

LARGEST_CHANGE, MOST_OF_A_NODE = 0.5, 20.0
"""Mean change of a film by a step, over itself, where it closes continuously, and what a node counts at the
most: an emptied valley lifts bodies by several films. With 1, with 0.2 and without, thin films fail."""

LINEAR = 1e-6
"""Change of the logarithm of the viscosity in a step that makes no difference."""

SMALLEST = 1e-300
"""So that nothing is divided by zero."""


class Length(NamedTuple):
    """How much of a step is taken."""

    part: float
    """Of the whole step, at most 1."""
    gap: np.ndarray | None = None
    """The gap that it leads to, (lines, nx), where that is known already."""
    falls: np.ndarray | None = None
    """What the gap falls by in a whole step, where films limit it."""


def step_length(problem, partition, evaluation, state, dP, dH0, settings, in_turn=False):
    """The `Length` of a step -dP (lines, nx), -dH0 from an evaluated state, by `NewtonSettings`
    (collective). `in_turn` says how the `Partition` is going to change sets."""
    part = _by_pressures(problem, state, dP, settings)
    if not settings.by_film:
        return Length(part)
    P = state.P - part * dP
    P[np.logical_or(*partition.tension(P, state.status, in_turn))] = problem.contact.tears_at
    H = problem.gap(P, state.H0 - part * dH0)
    allowed = LARGEST_CHANGE / max(mean_change(problem, evaluation, state, H), SMALLEST)
    falls = (state.H - H) / part
    return Length(part, H, falls) if allowed >= 1.0 else Length(part * allowed, falls=falls)


def as_oil_flows(problem, evaluation, state, dP):
    """The step -dP (lines, nx) with films that fall as far as the oil's flow is linear in what falls.

    By a monotone mean what pressure drives between two nodes is the difference of their reduced pressures
    q = (1 - e^(-alpha P))/alpha, not of P: where P falls in stiff oil, a step that is linear in P leads to
    several times the fall. -dP as a step of q is a fall of P by ln(1 + alpha dP)/alpha. Where the gap
    answers to the pressure instead, alpha counts for less. A rise by q has no bound: it is left.
    """
    fluid = evaluation.fluid
    stiffens = -own(fluid.deps_dP) / np.maximum(own(fluid.eps), SMALLEST)
    stiffens *= 1.0 - share_of_the_gap(problem, evaluation)
    exponent = stiffens * dP
    bent = (state.status == LUBRICATED) & (dP > 0.0) & (exponent > LINEAR)
    falls = dP.copy()
    falls[bent] = np.log1p(exponent[bent]) / stiffens[bent]
    return falls


def _by_pressures(problem, state, dP, settings):
    """Part of the step by which no pressure changes too much. A film falls to the pressure at which it
    tears and no further, whatever a step asks for."""
    room = np.where(state.status == LUBRICATED, state.P - problem.contact.tears_at, np.inf)
    largest = problem.grid.max(np.abs(np.minimum(dP, room)), initial=0.0)
    limit = settings.max_pressure_step
    if settings.over_largest:
        limit *= max(1.0, problem.grid.max(state.P, initial=0.0))
    return min(1.0, limit / max(largest, SMALLEST))


def mean_change(problem, evaluation, state, H):
    """Mean change of the film over itself on the way to a gap H, (lines, nx). Deep valleys do not count:
    their gap says nothing of the film beside them."""
    is_thin = share_of_the_gap(problem, evaluation) > 0.5
    film = is_thin & (state.status == LUBRICATED) & (state.H > problem.scheme.contact_law.contact_gap)
    change = np.abs(H - state.H)[film] / state.H[film]
    total = problem.grid.sum(np.minimum(change, MOST_OF_A_NODE).sum())
    return total / max(problem.grid.count(film), 1)
