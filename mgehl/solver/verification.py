"""What must hold of an answer, checked on the final state without trust in the iteration."""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.status import (
    CAVITATED,
    CONTACT,
    LUBRICATED,
    enclosed,
    is_fluid,
    is_solid,
    open_faces,
)
from mgehl.solver.mass import border_flows

LARGEST_EDGE_PRESSURE = 0.1
"""Largest pressure near the domain's boundary, over the largest of all, of a contact that lies inside the
domain. Of 36 by chance, a side of whose domain came near, those with less lose at most 1 % of their film by
it; the sides of wide ellipses have up to 0.05 on domains that are "auto"."""

NEAR = 0.1
"""Where that pressure is looked at: at this part of the loaded zone's shorter half from the boundary, which
is a semi-axis at the least, as the pressure's slope there has it. A light roller, whose film loses 2 % by
the end of its domain, has 0.13; by a cell's distance it was 4e-3 on 513 nodes."""

FEWEST_NODES = 4
"""Fewest nodes of the loaded zone along each axis. Measured: 11 and more on domains that are "auto"."""

LOADED = 0.1
"""Pressure of the loaded zone over the largest: 0.995 semi-axes of a dry contact, more of a light one."""


@dataclass(frozen=True)
class Edge:
    """How a solution stands in its domain and on its grid."""

    pressure_ratio: float
    """Largest pressure near the domain's boundary over the largest of all; 0 without pressure."""
    overlapping: int
    """Nodes of the boundary where the bodies overlap."""
    largest_nm: float
    """The largest overlap there."""
    nodes_along_x: int
    """Nodes that the loaded zone is wide."""
    nodes_along_y: int | None
    """None of a line contact."""

    @property
    def cuts(self):
        """Whether the domain cuts the contact."""
        return self.overlapping > 0 or self.pressure_ratio > LARGEST_EDGE_PRESSURE

    @property
    def too_few(self):
        """What is wrong with the number of nodes, in a sentence; empty where nothing is."""
        for axis, nodes in (("x", self.nodes_along_x), ("y", self.nodes_along_y)):
            if nodes is not None and nodes < FEWEST_NODES:
                return (
                    f"the contact is {nodes} nodes wide along {axis}, and needs {FEWEST_NODES}: "
                    "a smaller domain or more nodes"
                )
        return ""

    @property
    def wrong(self):
        """What is wrong, in a few words and in a sentence; both empty where nothing is."""
        if self.overlapping:
            return "the bodies overlap on the boundary", (
                f"the bodies overlap at {self.overlapping} nodes of the domain's boundary by up to "
                f"{self.largest_nm:.3g} nm: the domain cuts the contact"
            )
        if self.cuts:
            return "the domain cuts the contact", (
                f"the pressure near the domain's boundary is {100 * self.pressure_ratio:.2g} % of the "
                f"largest, more than {100 * LARGEST_EDGE_PRESSURE:g} %: the domain cuts the contact"
            )
        return ("the contact has too few nodes", self.too_few) if self.too_few else ("", "")


NOT_SEEN = Edge(0.0, 0, 0.0, FEWEST_NODES, None)
"""Of a bearing, whose gap is given, and of results made by hand."""


def check_edge(problem, state, part=LOADED):
    """How the contact stands in its domain: what lies beyond was not solved (collective). The loaded zone
    has at least this `part` of the largest pressure."""
    grid, P = problem.grid, state.P
    largest, overlap = grid.max(P), np.where(problem.boundary, -state.H, 0.0)
    loaded = largest * part <= P
    columns = np.logical_or.reduce(grid.comm.allgather(loaded.any(axis=0)))
    across = None if grid.mesh.is_line else grid.count(loaded.any(axis=1))
    near = _pressure_near_boundary(problem, P, np.count_nonzero(columns), across)
    return Edge(
        pressure_ratio=near / largest if largest > 0.0 else 0.0,
        overlapping=grid.count(overlap > 0.0),
        largest_nm=1e9 * problem.contact.film_scale * grid.max(overlap, initial=0.0),
        nodes_along_x=int(np.count_nonzero(columns)),
        nodes_along_y=across,
    )


def _pressure_near_boundary(problem, P, along, across):
    """Largest pressure `NEAR` the boundary, to where it falls from there as to the node beside. The loaded
    zone has so many nodes `along` X and `across`."""
    grid, contact = problem.grid, problem.contact
    scales, cells = (contact.x_scale, contact.y_scale), (grid.mesh.dX, grid.mesh.dY)
    sizes = [(along - 1) * cells[0] * scales[0]]
    if across is not None:
        sizes.append((across - 1) * cells[1] * scales[1])
    half = 0.5 * min(sizes)
    return max(
        grid.max(P[nodes], initial=0.0) * NEAR * max(half / scale, 1.0) / cell
        for nodes, cell, scale in zip(grid.beside_boundary(), cells, scales, strict=True)
    )


def complementarity_error(problem, state, evaluation):
    """Largest breach of the conditions that define the partition, in units of P and H. Where every gap is
    larger than that unit, what flows into cavities and fills them is in units of the smallest gap.

    Lubricated: P >= p_t (if film tears) and H >= 0 (where bodies may touch). Cavitated: P = p_t, H >= 0, no
    more fluid than the gap holds, inflow balanced. Contact: P >= p_t and H = 0, or the boundary film, p_t
    <= p <= P and inflow balanced. Fluid shut in: 1. Released contact's H may be up to H_th.
    """
    grid, status, scheme = problem.grid, state.status, problem.scheme
    law = scheme.contact_law
    cavity, contact = status == CAVITATED, status == CONTACT
    tension = contact | (status == LUBRICATED) if scheme.cavitation else contact
    tears_at = problem.contact.tears_at
    unit = max(1.0, grid.min(state.H))
    breaches = [
        tears_at - state.P[tension],
        np.abs(state.P[cavity] - tears_at),
        _out_of_balance(evaluation.inflow[cavity], law) * grid.mesh.dX / unit,
        (state.filling[cavity] - 1.0) * state.H[cavity] / unit,
        np.abs(state.H[contact] - law.contact_gap),
    ]
    if law.closes_faces:
        breaches.append(enclosed(grid.halo_status(status), problem.axes).astype(float))
    else:
        breaches.append(np.abs(evaluation.inflow[contact]) * grid.mesh.dX)
        breaches += [tears_at - state.p[contact], state.p[contact] - state.P[contact]]
    if law.has_contact:
        breaches.append(law.contact_gap - state.H[is_fluid(status)])
    return max(grid.max(breach, initial=0.0) for breach in breaches)


def _out_of_balance(inflow, law):
    """How far cavities are from rest; where bodies may overlap they are full, and lose what they may."""
    return np.abs(inflow) if law.has_contact else inflow


def flux_imbalance(problem, evaluation):
    """Flow into the film minus flow out of it over all its borders, domain's edge and cavities, relative to
    the inflow: of a conservative scheme rounding and the residual."""
    borders = border_flows(evaluation, evaluation.status == LUBRICATED)
    flow = np.concatenate([width * each for width, *flows in borders for each in flows])
    total = problem.grid.sum(flow.sum())
    inflow = problem.grid.sum(flow[flow > 0.0].sum())
    return abs(total) / inflow if inflow > 0.0 else 0.0


def closed_face_flow(problem, evaluation):
    """Largest flow through a face that contact closes: what leaks through solid  [Liu eq. 4]."""
    leaks = []
    for axis, both in zip(evaluation.axes, evaluation.flows, strict=True):
        shut = ~open_faces(is_solid(evaluation.status), axis)
        leaks += [flow.value[shut] for flow in both]
    return max(problem.grid.max(np.abs(leak), initial=0.0) for leak in leaks)
