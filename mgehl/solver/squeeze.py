"""Implicit time steps that include the squeeze flow d(rho H)/dt.

The time step grows as the residual falls. The squeeze flow keeps a Newton step from closing a film that the
steady equations leave open. So, from one speed to the next, contact grows node by node and not in spots.
Besides, each node has a time step of its own, in which its own flow changes its film by about as much as
there is.

Where the mean of the mobility vanishes with either side, the flow out of a node has a fold: more pressure
makes the fluid stiffer, and may drive less of it out. Beyond the fold the pressure runs away, and near it a
Newton step is as good as random. There the time step is so short that the node is stable by itself. It
passes the fold slowly: for some steps the residual hardly falls, then it does.

By every mean there is another fold, between rough bodies: at a peak beside a valley more pressure opens the
gap, and lets more in than it keeps out. Soft bodies open by several films so. Rates that keep nodes from
this fold, too, take up to 2.4 times the work of what is found anyway.
"""

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.residual import linearise
from mgehl.discretization.rows import FLOW
from mgehl.discretization.status import beside_contact

SQUEEZE = 3.0
"""Rate, per rms residual and cell, that contact starts and continuation take at the least. From 0.3 to 9
full contact takes the same steps, mixed lubrication 65 to 58 convolutions, a film by the geometric mean 317
to 419."""

OF_NODES = 0.3
"""Part of the rate that follows a node's own residual and film: by its own flow a film changes by about
as much as there is in a step. With 0.1 it may open by three times as much; where oil hardly stiffens its
neighbours follow, and the residual rises. Of twelve contacts of machines (129 nodes), four of them hard, 10
are found with 0.1, all with 0.3 and 1; seven usual ones (257 nodes) take 1654, 1690 and 2172 convolutions.
"""

STABLE = 0.6
"""Rate per cell by which a node is kept from its fold: its neighbours bring it nearer. Points on 129 nodes
by the harmonic mean from their neighbours in speed: 21 of 21; with 0.3 18, with 1 20 in more steps. With
0.06 films take up to twice the work, with 1.8 ten times as much, or fail."""

LAST_STEPS = 1e-6
"""Rms residual below which it is kept so by less and less: Newton's own steps end the solve. From 1e-7 to
1e-5 the same by the geometric mean, by the harmonic 823 to 690 convolutions."""

THINNEST = 1e-9
"""Film of which a node's own rate is reckoned where H_th (1e-6 of the paper's ball) does not say more: so
that nothing is divided by zero. From 1e-12 to 1e-6 the same steps."""


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
    """How much of each node's residual only another gap can undo, (lines, nx).

    In a deep valley a thousandth of the pressure does: as it fills or tears its residual is large, and says
    nothing of how far the gap may go (a ball of 218 nm rms at .3 mm/s: 15 steps for 20).
    """
    return 1.0 / (1.0 + own(evaluation.fluid.eps) / (problem.K00 * problem.grid.mesh.dX))


def _stable_rates(problem, evaluation, rows, rms):
    """Rates with which the inflow of each film node falls as its own pressure lifts it: (lines, nx).

    Not of nodes beside contact, which holds them down: they lift by less than their own influence,
    and half of the rate that would do is worse than none.
    """
    steady = linearise(evaluation, rows)
    by_own_gap = steady.A[0] / problem.K00 + steady.B[0]
    margin = STABLE * min(1.0, rms / LAST_STEPS) / problem.grid.mesh.dX
    free = (rows == FLOW) & ~beside_contact(evaluation.status, evaluation.axes)
    return np.where(free, np.maximum(by_own_gap + margin, 0.0), 0.0)
