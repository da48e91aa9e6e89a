"""Flow through the faces of the control volumes, with its linearisation  [Liu eqs. 27-34].

This is the only place where a flow is computed. Contact closes a face for both kinds of flow,
which is the whole of the no-flow half of the interface conditions [Liu eq. 4].
"""

import numpy as np

from mgehl.discretization.couette import SCHEMES, WW, E, W, add_couette
from mgehl.discretization.fluid import FACE_MEANS
from mgehl.discretization.status import open_x_faces, open_y_faces


class Flow:
    """A flow through faces and, if `linearised`, its derivatives by P and H at WW, W and E.

    For faces between lines W stands for the line before and E for the line after.
    """

    def __init__(self, shape, linearised):
        self.value = np.zeros(shape)
        self.linearised = linearised
        if linearised:
            self.by_P = [np.zeros(shape) for _ in (WW, W, E)]
            self.by_H = [np.zeros(shape) for _ in (WW, W, E)]

    def close(self, is_open):
        """Nothing passes where `is_open` is False."""
        arrays = [self.value, *self.by_P, *self.by_H] if self.linearised else [self.value]
        for array in arrays:
            array *= is_open


def x_flows(fluid, status, mesh, scheme, mean, linearised=False):
    """Flows (leaving W, entering E) through the x faces of lines: rho H - eps dP/dX.

    `fluid` and `status` are (lines, nx), the flows (lines, nx - 1). Both are one object for a
    conservative scheme.
    """
    lines, nx = status.shape
    leaving = Flow((lines, nx - 1), linearised)
    entering = leaving if SCHEMES[scheme].conservative else Flow((lines, nx - 1), linearised)
    is_open = open_x_faces(status)
    for flow in {id(leaving): leaving, id(entering): entering}.values():
        _add_poiseuille(flow, fluid[:, :-1], fluid[:, 1:], mesh.dX, mean)
    add_couette(leaving, entering, fluid, scheme)
    leaving.close(is_open)
    if entering is not leaving:
        entering.close(is_open)
    return leaving, entering


def y_flows(fluid, status, mesh, mean, linearised=False):
    """Flow k_e^2 (-eps dP/dY) through the faces between consecutive lines, (lines - 1, nx)."""
    lines, nx = status.shape
    flow = Flow((lines - 1, nx), linearised)
    _add_poiseuille(flow, fluid[:-1], fluid[1:], mesh.dY / mesh.k_e**2, mean)
    flow.close(open_y_faces(status))
    return flow


def _add_poiseuille(flow, west, east, spacing, mean):
    """Add -eps (P_E - P_W)/spacing with eps the face's mean mobility  [Liu eqs. 7, 16, 30]."""
    eps, by_west, by_east = FACE_MEANS[mean](west.eps, east.eps)
    gradient = (east.P - west.P) / spacing
    flow.value -= eps * gradient
    if flow.linearised:
        conductance = eps / spacing
        flow.by_P[W] += conductance - gradient * by_west * west.deps_dP
        flow.by_P[E] -= conductance + gradient * by_east * east.deps_dP
        flow.by_H[W] -= gradient * by_west * west.deps_dH
        flow.by_H[E] -= gradient * by_east * east.deps_dH
