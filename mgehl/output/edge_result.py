"""Whether the domain holds the contact and the grid shows it; what is wrong, in words."""

from dataclasses import dataclass

from mgehl.solver.verification import FEWEST_NODES, LARGEST_EDGE_PRESSURE, LOADED, check_edge


@dataclass(frozen=True)
class EdgeResult:
    """Whether the domain holds the contact and the grid shows it: see `solver.verification.check_edge`."""

    pressure_ratio: float
    """Largest pressure near the domain's boundary over the largest of all."""
    overlapping: int
    """Nodes of the boundary where the bodies overlap."""
    largest_nm: float
    nodes_along_x: int
    """Nodes that the loaded zone is wide."""
    nodes_along_y: int | None
    """None of a line contact."""

    @property
    def wrong(self):
        """What is wrong, in a few words and in a sentence; both empty where nothing is."""
        if self.cuts:
            return self._cut
        return ("the contact has too few nodes", self.too_few) if self.too_few else ("", "")

    @property
    def cuts(self):
        """Whether the domain cuts the contact."""
        return self.overlapping > 0 or self.pressure_ratio > LARGEST_EDGE_PRESSURE

    @property
    def _cut(self):
        """The same in words."""
        if self.overlapping:
            return "the bodies overlap on the boundary", (
                f"the bodies overlap at {self.overlapping} nodes of the domain's boundary by up to "
                f"{self.largest_nm:.3g} nm: the domain cuts the contact"
            )
        return "the domain cuts the contact", (
            f"the pressure near the domain's boundary is {100 * self.pressure_ratio:.2g} % of the "
            f"largest, more than {100 * LARGEST_EDGE_PRESSURE:g} %: the domain cuts the contact"
        )

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


NOT_SEEN = EdgeResult(0.0, 0, 0.0, FEWEST_NODES, None)
"""Of results made by hand."""


def edge_result(problem, state, nm, part=LOADED):
    """The `EdgeResult` of a state; `nm` is nanometres per unit of H (collective).

    The loaded zone has at least this `part` of the largest pressure.
    """
    edge = check_edge(problem, state, part)
    return EdgeResult(edge.pressure, edge.overlapping, nm * edge.largest_overlap, *edge.across)
