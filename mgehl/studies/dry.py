"""The dry contact of smooth, wavy and rough balls beside a public code's numbers."""

import time
from dataclasses import dataclass
from pathlib import Path

from mgehl.config import config_from_tables
from mgehl.run import solve
from mgehl.studies import dry_surfaces
from mgehl.studies.dry_reference import REFERENCE, WORK
from mgehl.studies.study import merged, papers_grid

NODES = (129, 257)

BASE = {
    "contact": {
        "load": dry_surfaces.LOAD,
        "radius_x": dry_surfaces.RADIUS,
        "radius_y": dry_surfaces.RADIUS,
        "reduced_modulus": dry_surfaces.MODULUS,
    },
    "discretization": {"contact_model": "dry"},
}

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


@dataclass(frozen=True)
class Case:
    """A result and the processors' time that it took."""

    surface: str
    nodes: int
    result: object
    cpu: float


def run(study):
    """Solve all; write the table `dry`."""
    nodes = study.nodes or NODES
    study.cases = len(SURFACES) * len(nodes)
    cases = [_solve(study, surface, n) for surface in SURFACES for n in nodes]
    study.write_table("dry", [_row(case) for case in cases])


def tables_of(surface, nodes):
    """The configuration of a case, as nested tables."""
    function = SURFACES[surface]
    own = {"contact": {"surface": f"{Path(dry_surfaces.__file__)}:{function}"}} if function else {}
    return merged(BASE, own, {"grid": papers_grid(nodes)})


def _solve(study, surface, nodes):
    """Not by the study's cache: its time is wanted."""
    started = time.process_time()
    result = solve(config_from_tables(tables_of(surface, nodes)), study.comm).result
    cpu = study.comm.allreduce(time.process_time() - started)
    study.failures += not result.converged
    study.tell(f"{surface}, {nodes} nodes", result)
    return Case(surface, nodes, result, cpu)


def _row(case):
    result = case.result
    known = REFERENCE.get((case.surface, case.nodes))
    work = WORK.get((case.surface, case.nodes))
    return {
        "surface": case.surface,
        "nodes": str(case.nodes),
        "converged": "yes" if result.converged else "no",
        "contact nodes": str(result.contact.nodes),
        "public code's": str(known.contact_nodes) if known else "",
        "area / Hertz": f"{result.contact.area_fraction:.5f}",
        "p_max GPa": f"{result.max_pressure_GPa:.6f}",
        "public code's p_max": f"{known.max_pressure:.6f}" if known else "",
        "approach um": f"{result.approach_um:.6f}",
        "public code's approach": f"{known.approach:.6f}" if known else "",
        "convolutions": f"{result.work.convolutions:.1f}",
        "public code's convolutions": str(work.convolutions) if work else "",
        "CPU s": f"{case.cpu:.2f}",
        "public code's CPU s": f"{work.cpu:.2f}" if work else "",
    }
