"""A gap that is given between the nodes, too: what it carries and lets through is exact, edges and all.

Between two nodes a distance d apart q = c h - (rho/(eta lambda)) h^3 dP/dx is the same everywhere, so

    q = c `carried` - (rho/(eta lambda)) `cubed` (P_E - P_W)/d        [derived]
    cubed = d / int h^-3 dx,  carried = cubed int h^-2 dx / d

The oil is differenced as elsewhere, in a gap of 1.

At an edge between the nodes a film may tear. A torn film has P = 0 at the edge, and what it lets through is
the q of the way up to the edge. Of both flows the lesser is taken: the other needs P < 0 at the edge.
"""

from dataclasses import dataclass, replace

import numpy as np

from mgehl.discretization.faces import flows
from mgehl.discretization.flow import SHIFT, E, W


@dataclass(frozen=True)
class FaceGap:
    """What takes the place of H and H^3 at the faces along an axis; arrays of its faces."""

    carried: np.ndarray
    cubed: np.ndarray
    has_edge: np.ndarray | None = None
    """Faces that an edge lies beside; None along an axis that nothing is carried along."""
    to_edge: "FaceGap | None" = None
    """That of the way from the node that oil is carried from to the edge."""

    def of_lines(self, axis, lines):
        """That of the faces of some `lines` of nodes (a slice)."""
        found = FaceGap(axis.of_lines(self.carried, lines), axis.of_lines(self.cubed, lines))
        if self.to_edge is None:
            return found
        edges = {
            "has_edge": axis.of_lines(self.has_edge, lines),
            "to_edge": self.to_edge.of_lines(axis, lines),
        }
        return replace(found, **edges)


def flows_past_edges(fluid, status, axis, scheme, mobility, linearised, gap):
    """As `faces.flows`, `mobility` by the cube of a `FaceGap`, which may have edges where oil tears."""
    found = flows(fluid, status, axis, scheme, mobility, linearised, gap)
    if gap.to_edge is None or not scheme.cavitation:
        return found
    to_edge = mobility.times(gap.to_edge.cubed / gap.cubed)
    torn = flows(fluid, status, axis, scheme, to_edge, linearised, gap.to_edge)
    sense = 1.0 if axis.couette >= 0.0 else -1.0
    for whole, ending in dict(zip(found, torn, strict=True)).items():  # both may be one
        _end_at_the_edge(ending, fluid, axis, to_edge)
        whole.replace(ending, gap.has_edge & (sense * ending.value < sense * whole.value))
    return found


def _end_at_the_edge(flow, fluid, axis, mobility):
    """Let a flow be that to P = 0, whatever the pressure of the node behind the edge. (That this pressure
    changes the mean mobility is left out of the derivatives: Newton's steps hardly need it.)"""
    behind, sign = (E, 1.0) if axis.couette >= 0.0 else (W, -1.0)
    conductance = sign * mobility.value / axis.distance
    flow.value += conductance * axis.at(fluid.P, SHIFT[behind])
    if flow.is_linearised:
        has_pressure = 1.0 if fluid.torn is None else ~axis.at(fluid.torn, SHIFT[behind])
        flow.by_P[behind] += has_pressure * conductance
