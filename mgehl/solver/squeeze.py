"""Implicit time steps that include the squeeze flow d(rho H)/dt.

They grow as the residual falls. Squeeze keeps a Newton step from closing a film, so that contact grows node
by node. Each node also has a step of its own, in which its own flow changes its film by as much.

Where the mobility vanishes with either side, more pressure may drive less out of a node: beyond this fold
pressure runs away. There the step is so short that the node is stable by itself. Rates that keep rough
nodes from their other fold, where pressure lets more in by opening the gap, cost up to 2.4 times the work.
"""

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.residual import linearise
from mgehl.discretization.rows import FLOW
from mgehl.discretization.status import beside_contact

SQUEEZE = 3.0
"""Rate, per rms residual and cell, that contact starts and continuation take at the least; 0.3 to 9 do."""

OF_NODES = 0.3
"""Part of the rate that follows a node's own residual and film. With 0.1 a film may open threefold; where
oil hardly stiffens its neighbours follow, and contacts are lost. With 1 the work grows by a third."""

STABLE = 0.6
"""Rate per cell by which a node is kept from its fold: its neighbours bring it nearer. With half of it
points of the harmonic mean are lost, with 1.8 films take ten times the work."""

LAST_STEPS = 1e-6
"""Rms residual below which it is kept so by less and less: Newton's own steps end the solve."""

THINNEST = 1e-9
"""Film of which a node's own rate is reckoned at the least: so that nothing is divided by zero."""


def squeeze_rates(problem, evaluation, rows, F, settings):
    """1/time step of every node, (lines, nx), at a state of residual `F`; 0.0 where there is no squeeze."""
    if settings.squeeze == 0.0:
        return 0.0
    law = problem.scheme.contact_law
    rms = problem.rms(F * share_of_the_gap(problem, evaluation) if settings.by_film else F)
    own_part = OF_NODES * np.abs(F) / np.maximum(own(evaluation.H), max(law.thinnest, THINNEST))
    rates = settings.squeeze * (rms / problem.grid.mesh.dX + own_part)
    if not problem.scheme.may_fold:
        return rates
    return np.maximum(rates, _stable_rates(problem, evaluation, rows, rms))


def share_of_the_gap(problem, evaluation):
    """How much of each node's residual only another gap can undo, (lines, nx). A thousandth of the pressure
    does in a deep valley: its large residual says nothing of the gap."""
    return 1.0 / (1.0 + own(evaluation.fluid.eps) / (problem.K00 * problem.grid.mesh.dX))


def _stable_rates(problem, evaluation, rows, rms):
    """Rates with which the inflow of each film node falls as its own pressure lifts it: (lines, nx). Not of
    nodes beside contact, which holds them down: half of the rate that would do is worse than none."""
    steady = linearise(evaluation, rows)
    by_own_gap = steady.A[0] / problem.K00 + steady.B[0]
    margin = STABLE * min(1.0, rms / LAST_STEPS) / problem.grid.mesh.dX
    free = (rows == FLOW) & ~beside_contact(evaluation.status, evaluation.axes)
    return np.where(free, np.maximum(by_own_gap + margin, 0.0), 0.0)
