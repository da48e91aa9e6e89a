"""The pressure of a wedge along Y = 0, for files and pictures."""

import numpy as np

from mgehl.discretization.status import CONTACT


def centre_pressure(mesh, fields):
    """X and P of the nodes nearest to Y = 0, between the pad's edges; P is NaN in a pillar.

    The ambient pressure acts at the edge of the pad, not at the node half a cell outside, which is
    moved there; where that node is solid, the exit is blocked and the line ends at the last fluid.
    """
    _, j = mesh.centre
    X, P = mesh.X.copy(), fields.P[j].copy()
    X[[0, -1]] = mesh.edges
    solid = fields.status[j] == CONTACT
    P[solid] = np.nan
    within = slice(int(solid[0]), len(X) - int(solid[-1]))
    return X[within], P[within]
