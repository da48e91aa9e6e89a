"""The cavitation boundary with the gap held fixed: no convolution.

A Newton step moves the boundary by one layer of nodes, and the far field alone may need dozens.
Where Poiseuille flow dominates, H hardly depends on P, so the complementarity problem
P >= 0, net inflow <= 0 can be solved there at the present gap, by projected line sweeps.
"""

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.kernels import relax_cavitation
from mgehl.discretization.status import CAVITATED, LUBRICATED, is_fluid

WEAKLY_COUPLED = 10.0
"""A node is relaxed where its mobility/dX exceeds this multiple of its own influence."""

LONG_WAVES = 0.01
"""Smallest mobility of a relaxed node on a single line: there the grid is fine enough for waves of
many cells to be strongly coupled where neighbours are not, and Newton's steps and these would chase
each other (thick films on 4097 nodes; a plane of 2049 by 2049 nodes does without, in fewer steps)."""

LIFTED = 0.1
"""A node is not treated in a gap held fixed where its blocked flow lifts that gap by more than this part:
beside contact gap and pressure would take turns for ever (2049 nodes: 0.35 a step), and by a mean of
the mobility that vanishes with the film's no pressure drives the flow out of the gap as it is."""

SWEEPS = 40
"""Sweeps over all lines at the most; they end when one changes no status."""

PASSES = 2
"""Set iterations on a line in each sweep."""


def relax_cavitation_set(problem, state, evaluation):
    """Relax P and status of the weakly coupled fluid; return how many nodes changed, and the evaluation.

    `evaluation` is that of `state`, what is returned that of the state after. Updates `state` in place,
    but only if the set moved: otherwise Newton's pressures stand. Zebra order by global line number, so
    the number of ranks does not matter.
    """
    if not problem.scheme.cavitation:
        return 0, evaluation
    grid, P = problem.grid, evaluation.P.copy()
    faces = evaluation.source, *evaluation.conductances
    movable = _relaxable(problem, evaluation, state)
    lubricated = state.status == LUBRICATED
    for _ in range(SWEEPS):
        changes = 0
        for colour in (0, 1):
            first = (colour + grid.first) % 2
            changes += relax_cavitation(first, P, lubricated, movable, *faces, PASSES)
            grid.refresh(P)
        if grid.sum(changes) == 0:
            break
    relaxed = np.where(movable, np.where(lubricated, LUBRICATED, CAVITATED), state.status)
    moved = grid.count(relaxed != state.status)
    if moved:
        state.P[:] = own(P)
        state.status[:] = relaxed
        evaluation = problem.evaluate_moved(evaluation, P)
    return moved, evaluation


def weakly_coupled(problem, evaluation, status, multiple):
    """Fluid nodes whose gap hardly answers to their pressure; all (lines, nx)."""
    mobility = own(evaluation.fluid.eps)
    return is_fluid(status) & (mobility > multiple * problem.K00 * problem.grid.mesh.dX)


def driven(problem, evaluation):
    """Nodes whose flow the pressure drives out of the gap as it is, hardly lifting it: (lines, nx)."""
    lift = problem.K00 * np.abs(evaluation.source)
    return lift <= LIFTED * own(evaluation.H) * evaluation.conductance


def _relaxable(problem, evaluation, state):
    """Nodes that may be relaxed: as weakly coupled as that to waves of any length that matters."""
    movable = weakly_coupled(problem, evaluation, state.status, WEAKLY_COUPLED)
    if problem.grid.mesh.is_line:
        movable &= own(evaluation.fluid.eps) > LONG_WAVES
    return movable & driven(problem, evaluation)
