"""Rough line contacts drawn at random: rollers, gears and cams, with finishes that run across the motion.

No oil can flow around such a peak. As in study `machine`, domain, scheme and start are left to mgehl.
"""

from mgehl.studies.drawn import (
    RADIUS,
    SPEED,
    bodies,
    finished,
    found,
    layers,
    modulus_and_pressure,
    oil,
    p_h_of_one,
    run_drawn,
    self_affine,
    several,
)
from mgehl.studies.rough_ball import by_logarithm

NODES, CASES = 1025, 80

SHORTEST = (6.0, 60.0)
"""The shortest wave in cells of `NODES` nodes on the smooth bodies' domain."""


def run(study):
    """Solve all; write the tables `rollers` and `rollers-summary`."""
    run_drawn(study, "rollers", draw, row, NODES, CASES)


def draw(cases, seed):
    """So many `Drawn`. A longer list begins with the same cases."""
    return several(_drawn, cases, seed)


def _drawn(chance, number):
    """One case: a cylinder and its oil first, then a roughness for their film and their contact."""
    smooth = {
        "contact": _cylinder(chance) | layers(chance),
        "lubricant": oil(chance),
        "motion": {"speed": by_logarithm(chance, *SPEED)},
    }
    return finished(chance, number, smooth, surface_of, NODES, SHORTEST)


def _cylinder(chance):
    """Radius, modulus and the load that presses smooth bodies as hard as was drawn."""
    modulus, pressure = modulus_and_pressure(chance)
    body = {"kind": "line", "radius_x": by_logarithm(chance, *RADIUS), "reduced_modulus": modulus}
    return body | {"load_per_length": (pressure / p_h_of_one(body, "load_per_length")) ** 2}


def surface_of(chance, number, rms, shortest):
    """Waves, or a random profile."""
    if chance.random() < 0.5:
        return {"kind": "waviness", "amplitude": rms * 2.0**0.5, "wavelength_x": shortest}
    return self_affine(chance, number, rms, shortest)


def row(case, contact, result):
    """Text of one case, from its contact and its `Result`."""
    profile = "waves" if case.tables["surface"]["kind"] == "waviness" else "random"
    return bodies(case, contact) | {"profile": profile} | found(case, result)
