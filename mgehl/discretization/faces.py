"""Flow through the faces of the control volumes, with its linearisation  [Liu eqs. 27-34].

This is the only place where a flow is computed, along X and Y by the same lines. Contact closes a face
for both kinds of flow, which is the whole of the no-flow half of the interface conditions [Liu eq. 4].
"""

import numpy as np

from mgehl.discretization.couette import SHIFT, E, W, add_couette, couette_scheme, nodes_of
from mgehl.discretization.fluid import face_mobility
from mgehl.discretization.status import WALL, is_solid, open_faces


class Flow:
    """A flow through the faces along an axis and its derivatives by P and H at the nodes it depends on.

    `by_P` and `by_H` map node positions (WW, W, E, EE) to arrays of the flow's shape; no nodes,
    no derivatives, and none by H of a `rigid` gap.
    """

    def __init__(self, shape, nodes=(), rigid=False):
        self.value = np.zeros(shape)
        self.by_P = {node: np.zeros(shape) for node in sorted(nodes)}
        self.by_H = {node: np.zeros(shape) for node in sorted(nodes) if not rigid}

    def close(self, is_open):
        """Nothing passes where `is_open` is False."""
        for array in (self.value, *self.by_P.values(), *self.by_H.values()):
            array *= is_open


def flows(fluid, status, axis, scheme, linearised=False, rigid=False):
    """Flows (leaving W, entering E) through the faces along an axis: couette rho H - eps dP/distance.

    `fluid` and `status` are ghosted; the two are one object for a conservative scheme. Derivatives only
    if they are to be `linearised`, by H unless `rigid`.
    """
    table, derivatives = couette_scheme(scheme.couette, scheme.coarsenings), (linearised, rigid)
    leaving = _flow(fluid, status, axis, scheme, table.leaving, table.near, *derivatives)
    if table.conservative or not axis.couette:
        return leaving, leaving
    return leaving, _flow(fluid, status, axis, scheme, table.entering, table.near, *derivatives)


def _flow(fluid, status, axis, scheme, terms, near, linearised, rigid):
    """One flow, its Couette part by `terms`, beside what is solid by `near`."""
    is_open = open_faces(is_solid(status), axis)
    nodes = {W, E}
    if axis.couette:
        nodes |= nodes_of(terms) | nodes_of(near)
    flow = Flow(is_open.shape, nodes if linearised else (), rigid)
    _add_poiseuille(flow, fluid, axis, scheme)
    if scheme.couette_at_interface == "untreated":
        # Contact stops the pressure flow alone; nothing passes a wall.
        flow.close(is_open)
        stops = status == WALL
        is_open = open_faces(stops, axis)
    else:
        stops = is_solid(status)
    if axis.couette:
        add_couette(flow, terms, near, fluid, stops, axis)
    flow.close(is_open)
    return flow


def _add_poiseuille(flow, fluid, axis, scheme):
    """Add -eps (P_E - P_W)/distance with eps the face's mean mobility  [Liu eqs. 7, 16, 30]."""
    (west, east), distance = (_on_side(fluid, axis, side) for side in (W, E)), axis.distance
    eps = face_mobility(scheme, west, east)
    gradient = (east("P") - west("P")) / distance
    flow.value -= eps.value * gradient
    if flow.by_P:
        conductance = eps.value / distance
        flow.by_P[W] += conductance - gradient * eps.by_P[0]
        flow.by_P[E] -= conductance + gradient * eps.by_P[1]
    if flow.by_H:
        flow.by_H[W] -= gradient * eps.by_H[0]
        flow.by_H[E] -= gradient * eps.by_H[1]


def _on_side(fluid, axis, side):
    """A part of the fluid, by its name, at the nodes on one side of the faces."""
    return lambda name: axis.at(getattr(fluid, name), SHIFT[side])


def conductances(fluid, status, axis, scheme):
    """Mobility of the faces along an axis over cell times distance, zero where closed.

    With them the Poiseuille flow into a node is a sum over its faces of conductance times pressure
    difference. `fluid` and `status` are ghosted.
    """
    eps = face_mobility(scheme, _on_side(fluid, axis, W), _on_side(fluid, axis, E)).value
    return eps * open_faces(is_solid(status), axis) / (axis.distance * axis.cell)
