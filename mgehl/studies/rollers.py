"""Rough line contacts drawn at random: rollers, gears and cams, with finishes that run across the motion.

No oil can flow around such a peak. As in study `machine`, domain, scheme and start are left to mgehl.
"""

import numpy as np

from mgehl.studies.machine import (
    LONGEST,
    RADIUS,
    SPEED,
    Drawn,
    found,
    layers,
    modulus_and_pressure,
    oil,
    p_h_of_one,
    rms_and_shortest,
    run_drawn,
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
    return [_drawn(np.random.default_rng([seed, number]), number) for number in range(1, cases + 1)]


def _drawn(chance, number):
    """One case: bodies and oil first, then a roughness for their film and their contact."""
    smooth = {
        "contact": _bodies(chance) | layers(chance),
        "lubricant": oil(chance),
        "motion": {"speed": by_logarithm(chance, *SPEED)},
    }
    rms, shortest = rms_and_shortest(chance, smooth, NODES, SHORTEST)
    return Drawn(number, smooth | {"surface": surface_of(chance, number, rms, shortest)})


def _bodies(chance):
    """Radius, modulus and the load that presses smooth bodies as hard as was drawn."""
    modulus, pressure = modulus_and_pressure(chance)
    bodies = {"kind": "line", "radius_x": by_logarithm(chance, *RADIUS), "reduced_modulus": modulus}
    return bodies | {"load_per_length": (pressure / p_h_of_one(bodies, "load_per_length")) ** 2}


def surface_of(chance, number, rms, shortest):
    """Waves, or a random profile."""
    if chance.random() < 0.5:
        return {"kind": "waviness", "amplitude": rms * 2.0**0.5, "wavelength_x": shortest}
    return {
        "kind": "self-affine",
        "rms": rms,
        "hurst": float(chance.uniform(0.5, 0.95)),
        "seed": number,
        "shortest_wavelength": shortest,
        "longest_wavelength": shortest * by_logarithm(chance, *LONGEST),
    }


def row(case, contact, result):
    """Text of one case, from its contact and its `Result`."""
    return {
        "case": str(case.number),
        "E' GPa": f"{1e-9 * contact.reduced_modulus:.0f}",
        "p_h GPa": f"{1e-9 * contact.hertz.p_h:.3g}",
        "profile": "waves" if case.tables["surface"]["kind"] == "waviness" else "random",
    } | found(case, result)
