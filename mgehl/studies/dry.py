"""The dry contact of smooth, wavy and rough balls beside a public code's numbers."""

from pathlib import Path
from typing import NamedTuple

from mgehl.studies import dry_surfaces
from mgehl.studies.columns import told
from mgehl.studies.study import merged, papers_grid

NODES = (129, 257)

BASE = {"discretization": {"contact_model": "dry"}}
"""Of the paper's ball."""

SURFACES = {
    "smooth": None,
    "wavy 50 nm": "wavy_50",
    "wavy 200 nm": "wavy_200",
    "wavy 1 um": "wavy_1000",
    "ridge 200 nm": "ridge_200",
    "rough 50 nm": "rough_50",
    "rough 200 nm": "rough_200",
    "rough 500 nm": "rough_500",
}
"""Functions of `dry_surfaces` by what they are called."""


class Reference(NamedTuple):
    """Nodes in contact, largest pressure in GPa, approach in um, and convolutions that they took."""

    contact_nodes: int
    max_pressure: float
    approach: float
    convolutions: int


REFERENCE = {
    ("smooth", 129): Reference(5393, 2.263137, 13.289746, 50),
    ("smooth", 257): Reference(21523, 2.263097, 13.290003, 54),
    ("wavy 50 nm", 129): Reference(5403, 2.383120, 13.291814, 54),
    ("wavy 50 nm", 257): Reference(21545, 2.382500, 13.292027, 60),
    ("wavy 200 nm", 129): Reference(5409, 2.742123, 13.292494, 52),
    ("wavy 200 nm", 257): Reference(21607, 2.739792, 13.292674, 60),
    ("wavy 1 um", 129): Reference(4399, 4.630775, 13.158939, 60),
    ("wavy 1 um", 257): Reference(17409, 4.619498, 13.159511, 74),
    ("ridge 200 nm", 129): Reference(5421, 2.599292, 13.281467, 46),
    ("ridge 200 nm", 257): Reference(21691, 2.598336, 13.281677, 52),
    ("rough 50 nm", 129): Reference(5377, 2.733334, 13.287733, 54),
    ("rough 50 nm", 257): Reference(21429, 2.734929, 13.287958, 62),
    ("rough 200 nm", 129): Reference(5042, 4.401195, 13.257591, 62),
    ("rough 200 nm", 257): Reference(20097, 4.384155, 13.258240, 116),
    ("rough 500 nm", 129): Reference(3688, 7.651524, 13.096869, 96),
    ("rough 500 nm", 257): Reference(14486, 7.602938, 13.098811, 180),
}
"""By surface and nodes a side: runs of ContactMechanics 1.8.3 [Polonsky and Keer 1999] to its last digits,
and their convolutions by its default tolerances. Its discretisation is the same: uniform pressure on
rectangles around nodes, no periods."""


def run(study):
    """Solve all; write the table `dry`."""
    cases = {
        f"{surface}, {n} nodes": (surface, n) for surface in SURFACES for n in study.asked.nodes or NODES
    }
    tables = {name: tables_of(*case) for name, case in cases.items()}
    study.write_table("dry", [_row(*cases[name], each.result) for name, each in study.solved(tables)])


def tables_of(surface, nodes):
    """The configuration of a case, as nested tables."""
    function = SURFACES[surface]
    own = {"contact": {"surface": f"{Path(dry_surfaces.__file__)}:{function}"}} if function else {}
    return merged(BASE, own, {"grid": papers_grid(nodes)})


def _row(surface, nodes, result):
    known = REFERENCE.get((surface, nodes))
    return {
        "surface": surface,
        "nodes": str(nodes),
        **told(result, "converged, contact nodes"),
        "public code's": str(known.contact_nodes) if known else "",
        "area / Hertz": f"{result.contact.area_fraction:.5f}",
        "p_max GPa": f"{result.max_pressure_GPa:.6f}",
        "public code's p_max": f"{known.max_pressure:.6f}" if known else "",
        "approach um": f"{result.approach_um:.6f}",
        "public code's approach": f"{known.approach:.6f}" if known else "",
        **told(result, "convolutions"),
        "public code's convolutions": str(known.convolutions) if known else "",
    }
