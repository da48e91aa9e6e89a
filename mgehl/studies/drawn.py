"""Rough contacts drawn at random, for several studies: what chance chooses, how all are solved and shown.

Scheme and domain are those of a case of one's own, and so are bands and the start.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.config import config_from_tables
from mgehl.discretization.fluid import LINEAR_GAP
from mgehl.kinds import contact_from, mesh_from
from mgehl.output.digits import with_band
from mgehl.solver.from_config import OF_ROUGH
from mgehl.studies.rough_ball import by_logarithm
from mgehl.studies.study import merged, statistic, verdict

SEED = 7

HARD, SOFT = (226e9, 226e9, 226e9, 110e9), (20e9, 4e9)
"""E' in Pa: steel more often than bronze; soft metals and polymers."""
PRESSURE, PRESSURE_OF_SOFT = (0.4e9, 2.2e9), (0.01, 0.03)
"""Pressure of the smooth dry contact, from, to: of hard bodies in Pa, of soft ones over E'."""
RADIUS = (2e-3, 5e-2)
"""R_x in m."""
SPEED, VISCOSITY, PRESSURE_VISCOSITY = (1e-3, 3.0), (4e-3, 0.3), (8e-9, 24e-9)
LAMBDA, RMS = (0.03, 3.0), (1e-8, 1e-6)
"""Film of smooth bodies over the roughness, as far as the roughness in m stays within its limits."""
LONGEST = (2.0, 12.0)
"""The longest wave over the shortest."""
LAYERS = (0.0, 0.0, 0.0, 2e-9, 5e-9)
"""Boundary films in m."""

AS_BY_DEFAULT = {
    "discretization": {"couette": OF_ROUGH, "face_mobility": LINEAR_GAP},
    "solver": {"error": True},
}
"""What a study has otherwise, as a case of one's own has it."""


@dataclass(frozen=True)
class Drawn:
    """What chance chose for a case; `number` counts from 1 and is the seed of its surface."""

    number: int
    tables: dict
    """Its configuration but for the grid, nested."""

    @property
    def title(self):
        contact, surface = self.tables["contact"], self.tables["surface"]
        return f"{self.number}: {1e-9 * contact['reduced_modulus']:.0f} GPa, {surface['kind']}"


def run_drawn(study, name, draw, row, nodes, cases):
    """Solve what `draw(cases, seed)` finds; write a table of the `row` of each case and a summary.

    On so many `nodes`, and so many `cases`, where the study is not told others.
    """
    (nodes,) = study.nodes or (nodes,)
    drawn = draw(study.wanted or cases, SEED if study.seed is None else study.seed)
    study.cases = len(drawn)
    rows, results = [], []
    for case in drawn:
        tables = merged(AS_BY_DEFAULT, case.tables, {"grid": {"nodes": nodes}})
        solution = study.solve(case.title, tables)
        results.append(solution.result)
        rows.append(row(case, solution.contact, solution.result))
    study.write_table(name, rows)
    study.write_table(f"{name}-summary", summary(results))


def several(drawn, cases, seed):
    """So many of what `drawn(chance, number)` returns, each from a chance of its own."""
    return [drawn(np.random.default_rng([seed, number]), number) for number in range(1, cases + 1)]


def finished(chance, number, smooth, surface_of, nodes, shortest):
    """The `Drawn` of `smooth` bodies with a surface, whose roughness goes by their film.

    Its shortest wave has from, to so many cells of the smooth bodies' domain on so many nodes.
    """
    config = config_from_tables(merged(smooth, {"grid": {"nodes": nodes}}))
    contact = contact_from(config)
    rms = float(np.clip(contact.expected_film / by_logarithm(chance, *LAMBDA), *RMS))
    wave = by_logarithm(chance, *shortest) * contact.longest_cell(mesh_from(config, contact))
    return Drawn(number, smooth | {"surface": surface_of(chance, number, rms, wave)})


def modulus_and_pressure(chance):
    """E' and the pressure of the smooth dry contact, Pa: soft bodies one time in three."""
    soft = chance.random() < 1.0 / 3.0
    modulus = float(chance.choice(SOFT if soft else HARD))
    if soft:
        return modulus, modulus * by_logarithm(chance, *PRESSURE_OF_SOFT)
    return modulus, by_logarithm(chance, *PRESSURE)


def p_h_of_one(bodies, load):
    """Pressure of the smooth dry contact, Pa, under a load of one (N or N/m), whose key is `load`."""
    return contact_from(config_from_tables({"contact": bodies | {load: 1.0}})).hertz.p_h


def layers(chance):
    """What sticks to the surfaces."""
    return {"boundary_film": float(chance.choice(LAYERS))}


def oil(chance):
    """Section [lubricant]."""
    return {
        "viscosity": by_logarithm(chance, *VISCOSITY),
        "pressure_viscosity": by_logarithm(chance, *PRESSURE_VISCOSITY),
        "viscosity_law": str(chance.choice(("barus", "roelands"))),
    }


def self_affine(chance, number, rms, shortest):
    """A random surface without a direction."""
    return {
        "kind": "self-affine",
        "rms": rms,
        "hurst": float(chance.uniform(0.5, 0.95)),
        "seed": number,
        "shortest_wavelength": shortest,
        "longest_wavelength": shortest * by_logarithm(chance, *LONGEST),
    }


def bodies(case, contact):
    """Text of a case's number, modulus and pressure."""
    return {
        "case": str(case.number),
        "E' GPa": f"{1e-9 * contact.reduced_modulus:.0f}",
        "p_h GPa": f"{1e-9 * contact.hertz.p_h:.3g}",
    }


def found(case, result):
    """Text of roughness, film, gaps with their bands, and work."""
    mixed = result.mixed
    mean, loaded = (mixed.error.mean_nm, mixed.error.loaded_nm) if mixed.error else (None, None)
    return {
        "Sq nm": f"{mixed.Sq_nm:.0f}",
        "layers nm": f"{1e9 * case.tables['contact']['boundary_film']:.0f}",
        "lambda": f"{mixed.lambda_ratio:.3g}",
        "inlet cells": f"{result.resolution.inlet_cells:.2f}",
        "nodes in the shortest wave": f"{result.resolution.surface_nodes:.1f}",
        "load on contact %": f"{100.0 * mixed.contact_load_share:.2f}",
        "mean gap nm": with_band(mixed.mean_gap_nm, mean),
        "by pressure nm": with_band(mixed.loaded_gap_nm, loaded),
        "convolutions": f"{result.work.convolutions:.1f}",
        "verdict": verdict(result),
    }


def summary(results):
    """Rows of the summary of these `Result`s: verdicts, work, and how many gaps have a band."""
    converged = [each for each in results if each.converged]
    settled = sum(each.settled for each in results)
    work = [each.work.convolutions for each in converged]
    banded = sum(_has_band(each.mixed.error) for each in converged)
    numbers = {
        "cases": str(len(results)),
        "converged": f"{len(converged)} ({100 * len(converged) / len(results):.1f} %)",
        "settled, and in doubt": str(settled - len(converged)),
        "not settled": str(len(results) - settled),
        "convolutions of the converged, mean": statistic(np.mean, work),
        "convolutions of the converged, median": statistic(np.median, work),
        "of the converged, with a band about the mean gap": str(banded),
    }
    return [{"what": what, "value": value} for what, value in numbers.items()]


def _has_band(error):
    return error is not None and error.mean_nm is not None
