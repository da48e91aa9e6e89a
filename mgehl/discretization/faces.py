"""Flow through the faces of the control volumes, with its linearisation  [Liu eqs. 27-34].

This is the only place where a flow is computed, along X and Y by the same lines. Contact closes a face
for both kinds of flow, which is the whole of the no-flow half of the interface conditions [Liu eq. 4].
"""

from dataclasses import replace

import numpy as np

from mgehl.discretization.couette import add_couette, nodes_of
from mgehl.discretization.flow import SHIFT, E, Flow, W
from mgehl.discretization.fluid import FaceMobility, face_mobility
from mgehl.discretization.kernels import add_poiseuille, add_poiseuille_slopes
from mgehl.discretization.status import WALL, is_solid, open_faces


def flows(fluid, status, axis, scheme, mobility, linearised=False, gap=None):
    """Flows (leaving W, entering E) through the faces along an axis: couette rho H - eps dP/distance.

    `fluid` and `status` are ghosted, `mobility` is the `FaceMobility`; the two are one object for a
    conservative scheme. Derivatives only if they are to be `linearised`. A `FaceGap` takes the place of H.
    """
    couette = scheme.couette_flow
    solid = is_solid(status, scheme.contact_law.closes_faces)
    untreated = scheme.couette_at_interface == "untreated"  # contact stops the pressure flow alone
    stops = status == WALL if untreated else solid
    is_open = open_faces(stops, axis)

    def flow(terms):
        """One of the two, its Couette part by `terms`."""
        nodes = _nodes_of_flow(axis, terms, couette) if linearised else ()
        found = Flow(is_open.shape, nodes)
        _add_poiseuille(found, fluid, axis, mobility)
        if untreated:
            found.close(open_faces(solid, axis))
        if axis.couette:
            _add_carried(found, terms, couette, fluid, stops, axis, gap)
        found.close(is_open)
        return found

    leaving = flow(couette.leaving)
    conservative = couette.conservative or not axis.couette
    return leaving, leaving if conservative else flow(couette.entering)


def _add_carried(flow, terms, couette, fluid, stops, axis, gap):
    """Add the Couette flow by `terms` of a `CouetteScheme`: that of full gaps times the filling of the node
    it comes from. A full cavity loses what a film would, by every scheme."""
    if fluid.torn is None and gap is None:
        add_couette(flow, terms, couette, fluid, stops, axis)
        return
    of_full = Flow(flow.value.shape, flow.by_P)
    add_couette(of_full, terms, couette, fluid, stops, axis)
    if gap is not None:
        of_full.scale(gap.carried)
    if fluid.torn is None:
        flow.add(of_full)
        return
    upstream = W if axis.couette >= 0.0 else E  # against the axis: a wedge's plate
    filling, torn = (axis.at(part, SHIFT[upstream]) for part in (fluid.filling, fluid.torn))
    by_filling = of_full.value * torn
    of_full.scale(filling)
    flow.add(of_full)
    if flow.by_P:
        flow.by_P[upstream] += by_filling


def carried(fluid, status, axis, scheme, gap=None):
    """What leaves W through the faces along an axis with the surfaces, were all cavities full; arguments as
    of `flows`, and the mobility does not matter."""
    whole = replace(fluid, torn=None, filling=None, P=np.zeros(fluid.P.shape))
    still = FaceMobility(np.zeros(axis.of_whole(status)), (0.0, 0.0))
    return flows(whole, status, axis, scheme, still, gap=gap)[0].value


def nodes_of_flows(axis, scheme):
    """Positions of the nodes that the `flows` (leaving W, entering E) along an axis depend on."""
    couette = scheme.couette_flow
    return [_nodes_of_flow(axis, terms, couette) for terms in (couette.leaving, couette.entering)]


def _nodes_of_flow(axis, terms, couette):
    return {W, E} | (nodes_of(terms) | nodes_of(couette.near) if axis.couette else set())


def _add_poiseuille(flow, fluid, axis, mobility):
    """Add -eps (P_E - P_W)/distance with eps the face's mean mobility  [Liu eqs. 7, 16, 30]."""
    closeness = np.full(flow.value.shape[1], 1.0 / axis.distance)
    conductance = mobility.value * closeness
    add_poiseuille(axis.sides, fluid.P, conductance, flow.value)
    if not flow.is_linearised:
        return
    _add_by_mobilities(flow, fluid, axis, mobility, closeness)
    flow.by_P[W] += conductance
    flow.by_P[E] -= conductance
    if mobility.by_gap + mobility.by_rho:
        _add_by_gaps_and_densities(flow, fluid, axis, mobility, closeness)
    if fluid.torn is not None:
        for node in (W, E):
            flow.by_P[node] *= ~axis.at(fluid.torn, SHIFT[node])  # its pressure is given


def _add_by_mobilities(flow, fluid, axis, mobility, closeness):
    """Add what changes as the mobilities of both nodes do."""
    shape = 1, flow.value.shape[1]
    by_eps = [slope if np.ndim(slope) else np.full(shape, slope) for slope in mobility.by_eps]
    for slopes, eps_by in zip((flow.by_P, flow.by_H), fluid.mobility(axis)[1:], strict=True):
        add_poiseuille_slopes(axis.sides, fluid.P, closeness, *by_eps, eps_by, slopes[W], slopes[E])


def _add_by_gaps_and_densities(flow, fluid, axis, mobility, closeness):
    """Add what changes beside that, where a mean is one of gaps, or of densities, too."""
    gradient = (axis.at(fluid.P, SHIFT[E]) - axis.at(fluid.P, SHIFT[W])) * closeness
    for node, slope in zip((W, E), mobility.by_gap, strict=False):
        flow.by_H[node] -= gradient * slope
    for node, slope in zip((W, E), mobility.by_rho, strict=False):
        flow.by_P[node] -= gradient * slope * axis.at(fluid.drho_dP, SHIFT[node])


def mobility_of_faces(fluid, axis, scheme):
    """The `FaceMobility` of the faces along an axis; its slopes by the gap are by H."""
    sides = (W, E)
    eps = [axis.at(fluid.mobility(axis)[0], SHIFT[side]) for side in sides]
    gaps = [scheme.contact_law.flow_gap(axis.at(fluid.H, SHIFT[side])) for side in sides]
    rho = [axis.at(fluid.rho, SHIFT[side]) for side in sides]
    mobility = face_mobility(scheme, eps, [gap for gap, _ in gaps], rho)
    by_H = tuple(slope * by_H for slope, (_, by_H) in zip(mobility.by_gap, gaps, strict=False))
    return replace(mobility, by_gap=by_H)


def conductances(status, axis, scheme, mobility):
    """Mobility of the faces along an axis over cell times distance, zero where closed: times the pressure
    difference, the Poiseuille flow into a node. `status` is ghosted, `mobility` the `FaceMobility`."""
    solid = is_solid(status, scheme.contact_law.closes_faces)
    return mobility.value * open_faces(solid, axis) / (axis.distance * axis.cell)
