"""Rough line contacts drawn at random: rollers, gears and cams, with finishes that run across the motion.

No oil can flow around such a peak. Otherwise they are drawn as those of study `machine`.
"""

from mgehl.studies import machine
from mgehl.studies.chance import by_logarithm, run_drawn

NODES, CASES = 1025, 80

SHORTEST = (6.0, 60.0)
"""The shortest wave in cells of `NODES` nodes on the smooth bodies' domain."""


def run(study):
    """Solve all; write the tables `rollers` and `rollers-summary`."""
    run_drawn(study, "rollers", draw, row, NODES, CASES)


def draw(cases, seed):
    """So many `Drawn`. A longer list begins with the same cases."""
    return machine.several(_drawn, cases, seed)


def _drawn(chance, number):
    """One case: a cylinder and its oil first, then a roughness for their film and their contact."""
    smooth = machine.smooth_case(chance, _cylinder(chance))
    return machine.with_surface(chance, number, smooth, surface_of, NODES, SHORTEST)


def _cylinder(chance):
    """Radius, modulus and the load that presses smooth bodies as hard as was drawn."""
    modulus, pressure = machine.modulus_and_pressure(chance)
    body = {"kind": "line", "radius_x": by_logarithm(chance, *machine.RADIUS), "reduced_modulus": modulus}
    return body | {"load_per_length": (pressure / machine.p_h_of_one(body, "load_per_length")) ** 2}


def surface_of(chance, number, rms, shortest):
    """Waves, or a random profile."""
    if chance.random() < 0.5:
        return {"kind": "waviness", "amplitude": rms * 2.0**0.5, "wavelength_x": shortest}
    return machine.self_affine(chance, number, rms, shortest)


def row(case, solution):
    """Text of one case."""
    profile = "waves" if case.tables["surface"]["kind"] == "waviness" else "random"
    return machine.row_of(case, solution, {"profile": profile})
