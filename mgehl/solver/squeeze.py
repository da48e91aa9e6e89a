"""Implicit time steps with the squeeze flow d(rho H)/dt, longer as the residual falls.

The squeeze flow keeps a Newton step from closing a film that the steady equations leave open: from
one speed to the next the contact set then grows node by node and not in spots. A part of it is each
node's own, by its residual over its film: a film of an atom's height that fluid flows into opens by
a few of its heights a step. Without that its pressure shoots over the fold beyond which, by a mean of
the mobility that vanishes with the film, more pressure drives less flow.
"""

import numpy as np

SQUEEZE = 3.0
"""Rate, per rms residual and cell, that contact starts and continuation take at the least."""

OF_NODES = {"arithmetic": 0.1, "geometric": 0.1, "harmonic": 5.0}
"""Part of the rate that goes by a node's own residual and film, by the mean of the mobility.

By the harmonic mean the flow falls again from half the pressure difference on that it takes by the
geometric one, and single nodes come to folds everywhere: with no film growing by more than a
fifteenth a step, of 21 points on 129 nodes all are reached from their neighbours in speed (0.1: 11
of 21, 30: 5 in 100 steps). The other means take more steps with more.
"""

THINNEST = 1e-9
"""Film of which a node's own rate is reckoned where H_th does not say more."""


def squeeze_rates(problem, H, F, settings):
    """1/time step of every node, (lines, nx), at gap `H` and residual `F`; 0.0 if `settings` have none."""
    if settings.squeeze == 0.0:
        return 0.0
    floor = max(settings.film_threshold, problem.scheme.gap_floor or 0.0, THINNEST)
    own = OF_NODES[problem.scheme.face_mobility] * np.abs(F) / np.maximum(H, floor)
    return settings.squeeze * (problem.rms(F) / problem.grid.mesh.dX + own)
