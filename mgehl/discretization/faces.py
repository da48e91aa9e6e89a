"""Flow through the faces of the control volumes, with its linearisation  [Liu eqs. 27-34].

This is the only place where a flow is computed. Contact closes a face for both kinds of flow,
which is the whole of the no-flow half of the interface conditions [Liu eq. 4].
"""

import numpy as np

from mgehl.discretization.couette import SCHEMES, E, W, add_couette, nodes_of
from mgehl.discretization.fluid import face_mean
from mgehl.discretization.status import open_x_faces, open_y_faces


class Flow:
    """A flow through faces and its derivatives by P and H at the `nodes` it depends on.

    `by_P` and `by_H` map node positions (WW, W, E, EE) to arrays of the flow's shape; no nodes,
    no derivatives, and none by H of a `rigid` gap. For faces between lines W stands for the line
    before and E for the line after.
    """

    def __init__(self, shape, nodes=(), rigid=False):
        self.value = np.zeros(shape)
        self.by_P = {node: np.zeros(shape) for node in sorted(nodes)}
        self.by_H = {node: np.zeros(shape) for node in sorted(nodes) if not rigid}

    def close(self, is_open):
        """Nothing passes where `is_open` is False."""
        for array in (self.value, *self.by_P.values(), *self.by_H.values()):
            array *= is_open


def x_flows(fluid, status, mesh, scheme, linearised=False, rigid=False):
    """Flows (leaving W, entering E) through the x faces of lines: rho H - eps dP/dX.

    `fluid` and `status` are (lines, nx), the flows (lines, nx - 1). Both are one object for a
    conservative scheme. Derivatives only if they are to be `linearised`, by H unless `rigid`.
    """
    table, derivatives = SCHEMES[scheme.couette], (linearised, rigid)
    leaving = _x_flow(fluid, status, mesh, scheme, table.leaving, table.near, *derivatives)
    if table.conservative:
        return leaving, leaving
    return leaving, _x_flow(fluid, status, mesh, scheme, table.entering, table.near, *derivatives)


def y_flows(fluid, status, mesh, scheme, linearised=False, rigid=False):
    """Flow k_e^2 (-eps dP/dY) through the faces between consecutive lines, (lines - 1, nx)."""
    lines, nx = status.shape
    flow = Flow((lines - 1, nx), {W, E} if linearised else (), rigid)
    _add_poiseuille(flow, fluid[:-1], fluid[1:], mesh.dY / mesh.k_e**2, scheme)
    flow.close(open_y_faces(status))
    return flow


def _x_flow(fluid, status, mesh, scheme, terms, near, linearised, rigid):
    """One flow through the x faces, its Couette part by `terms`."""
    lines, nx = status.shape
    nodes = {W, E} | nodes_of(terms) | nodes_of(near) if linearised else ()
    flow = Flow((lines, nx - 1), nodes, rigid)
    _add_poiseuille(flow, fluid[:, :-1], fluid[:, 1:], mesh.pressure_dX, scheme)
    if scheme.couette_at_interface == "closed":
        add_couette(flow, terms, near, fluid, status, scheme.motion)
        flow.close(open_x_faces(status))
    else:
        flow.close(open_x_faces(status))
        add_couette(flow, terms, near, fluid, None, scheme.motion)
    return flow


def _add_poiseuille(flow, west, east, spacing, scheme):
    """Add -eps (P_E - P_W)/spacing with eps the face's mean mobility  [Liu eqs. 7, 16, 30]."""
    eps, by_west, by_east = face_mean(scheme, west.eps, east.eps)
    gradient = (east.P - west.P) / spacing
    flow.value -= eps * gradient
    if flow.by_P:
        conductance = eps / spacing
        flow.by_P[W] += conductance - gradient * by_west * west.deps_dP
        flow.by_P[E] -= conductance + gradient * by_east * east.deps_dP
    if flow.by_H:
        flow.by_H[W] -= gradient * by_west * west.deps_dH
        flow.by_H[E] -= gradient * by_east * east.deps_dH


def conductances(eps, status, mesh, scheme):
    """Mobility of the x faces over dX^2 and of the y faces over dY^2, zero where closed.

    `eps` and `status` are ghosted; the results (lines, nx - 1) and (lines + 1, nx). With them the
    Poiseuille flow into a node is a sum over its faces of conductance times pressure difference.
    """
    inner = eps[1:-1]
    along = face_mean(scheme, inner[:, :-1], inner[:, 1:])[0] * open_x_faces(status[1:-1])
    across = face_mean(scheme, eps[:-1], eps[1:])[0] * open_y_faces(status)
    return along / (mesh.pressure_dX * mesh.dX), across * (mesh.k_e / mesh.dY) ** 2
