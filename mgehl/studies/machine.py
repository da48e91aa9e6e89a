"""Rough contacts of machines drawn at random: bodies, oils, directions and finishes of every sort.

How many are solved, and how well are their mean gaps known?
"""

import numpy as np

from mgehl.config import config_from_tables
from mgehl.kinds import contact_from, mesh_from
from mgehl.output.digits import with_band
from mgehl.studies.chance import Drawn, answer, by_logarithm, run_drawn
from mgehl.studies.columns import told
from mgehl.studies.study import merged

NODES, CASES = 257, 60

HARD, SOFT = (226e9, 226e9, 226e9, 110e9), (20e9, 4e9)
"""E' in Pa: steel more often than bronze; soft metals and polymers."""
PRESSURE, PRESSURE_OF_SOFT = (0.4e9, 2.2e9), (0.01, 0.03)
"""Pressure of the smooth dry contact, from, to: of hard bodies in Pa, of soft ones over E'."""
RADIUS, RATIO = (2e-3, 5e-2), (0.3, 8.0)
"""R_x in m; R_y over R_x, 1 of two in five."""
SPEED, VISCOSITY, PRESSURE_VISCOSITY = (1e-3, 3.0), (4e-3, 0.3), (8e-9, 24e-9)
LAMBDA, RMS = (0.03, 3.0), (1e-8, 1e-6)
"""Film of smooth bodies over the roughness, as far as the roughness in m stays within its limits."""
SHORTEST, LONGEST = (6.0, 20.0), (2.0, 12.0)
"""The shortest wave in cells of the smooth bodies' domain, the longest over the shortest."""
LAYERS = (0.0, 0.0, 0.0, 2e-9, 5e-9)
"""Boundary films in m."""


def run(study):
    """Solve all; write the tables `machine` and `machine-summary`."""
    run_drawn(study, "machine", draw, row, NODES, CASES)


def draw(cases, seed):
    """So many `Drawn`. A longer list begins with the same cases."""
    return several(_drawn, cases, seed)


def several(drawn, cases, seed):
    """So many of what `drawn(chance, number)` returns, each from a chance of its own."""
    return [drawn(np.random.default_rng([seed, number]), number) for number in range(1, cases + 1)]


def _drawn(chance, number):
    """One case: bodies and oil first, then a roughness for their film and their contact."""
    smooth = smooth_case(chance, drawn_bodies(chance))
    smooth["motion"]["angle"] = _angle(chance)
    return with_surface(chance, number, smooth, surface_of, NODES, SHORTEST)


def drawn_bodies(chance):
    """Radii, modulus and the load that presses smooth bodies as hard as was drawn."""
    modulus, pressure = modulus_and_pressure(chance)
    radius = by_logarithm(chance, *RADIUS)
    ratio = by_logarithm(chance, *RATIO) if chance.random() < 0.6 else 1.0
    bodies = {"radius_x": radius, "radius_y": ratio * radius, "reduced_modulus": modulus}
    return bodies | {"load": (pressure / p_h_of_one(bodies, "load")) ** 3}


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


def smooth_case(chance, bodies):
    """The tables of `bodies` with layers, oil and speed."""
    return {
        "contact": bodies | {"boundary_film": float(chance.choice(LAYERS))},
        "lubricant": {
            "viscosity": by_logarithm(chance, *VISCOSITY),
            "pressure_viscosity": by_logarithm(chance, *PRESSURE_VISCOSITY),
            "viscosity_law": str(chance.choice(("barus", "roelands"))),
        },
        "motion": {"speed": by_logarithm(chance, *SPEED)},
    }


def with_surface(chance, number, smooth, surface_of, nodes, shortest):
    """The `Drawn` of `smooth` bodies with a surface, whose roughness goes by their film. Its shortest wave
    has from, to so many cells of the smooth bodies' domain on so many nodes."""
    config = config_from_tables(merged(smooth, {"grid": {"nodes": nodes}}))
    contact = contact_from(config)
    rms = float(np.clip(contact.expected_film / by_logarithm(chance, *LAMBDA), *RMS))
    wave = by_logarithm(chance, *shortest) * contact.longest_cell(mesh_from(config, contact))
    surface = surface_of(chance, number, rms, wave)
    what = f"{1e-9 * contact.reduced_modulus:.0f} GPa, {surface['kind']}"
    return Drawn(number, what, smooth | {"surface": surface, "solver": {"error": True}})


def _angle(chance):
    """Direction of the motion in degrees: along x two times in three."""
    return float(chance.uniform(5.0, 85.0)) if chance.random() < 1.0 / 3.0 else 0.0


def surface_of(chance, number, rms, shortest):
    """A random surface, or waves along x, along y or both."""
    if chance.random() < 0.4:
        waves = {f"wavelength_{name}": shortest * by_logarithm(chance, 1.0, 3.0) for name in "xy"}
        left_out = chance.choice(("wavelength_x", "wavelength_y", ""))
        waves.pop(str(left_out), None)
        return {"kind": "waviness", "amplitude": rms * 2.0 ** (0.5 * len(waves)), **waves}
    alike = self_affine(chance, number, rms, shortest)
    return alike | {"aspect": float(chance.choice((1.0, 1.0, 3.0, 6.0))), "angle": _angle(chance)}


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


def row(case, solution):
    """Text of one case."""
    contact = solution.contact
    of_point = {
        "R_y/R_x": f"{contact.radius_y / contact.radius_x:.2f}",
        "angle": f"{case.tables['motion']['angle']:.0f}",
        "surface": finish(case.tables["surface"]),
    }
    return row_of(case, solution, of_point)


def row_of(case, solution, shape):
    """Text of bodies, of their `shape`, of roughness, film and gaps with their bands, and of the answer."""
    contact, result, mixed = solution.contact, solution.result, solution.result.mixed
    mean, loaded = (mixed.error.mean_nm, mixed.error.loaded_nm) if mixed.error else (None, None)
    return {
        "case": str(case.number),
        "E' GPa": f"{1e-9 * contact.reduced_modulus:.0f}",
        "p_h GPa": f"{1e-9 * contact.hertz.p_h:.3g}",
        **shape,
        "Sq nm": f"{mixed.Sq_nm:.0f}",
        "layers nm": f"{1e9 * case.tables['contact']['boundary_film']:.0f}",
        **told(result, "lambda, inlet cells"),
        "nodes in the shortest wave": f"{result.resolution.surface_nodes:.1f}",
        "mean gap nm": with_band(mixed.mean_gap_nm, mean),
        "by pressure nm": with_band(mixed.loaded_gap_nm, loaded),
        **answer(result),
    }


def finish(surface):
    """A surface in a word or two."""
    if surface["kind"] == "waviness":
        ways = [name for name in "xy" if f"wavelength_{name}" in surface]
        return f"waves along {' and '.join(ways)}"
    return f"random {surface['aspect']:.0f}:1"
