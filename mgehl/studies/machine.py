"""Rough contacts of machines drawn at random: bodies, oils, directions and finishes of every sort.

Domain, scheme and start are left to mgehl, as a user who knows little of them leaves them. How many are
solved, and how well are their mean gaps known?
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

NODES, CASES = 257, 60

RATIO = (0.3, 8.0)
"""R_y over R_x, from, to; 1 of two in five."""
SHORTEST = (6.0, 20.0)
"""The shortest wave in cells of `NODES` nodes on the smooth bodies' domain."""


def run(study):
    """Solve all; write the tables `machine` and `machine-summary`."""
    run_drawn(study, "machine", draw, row, NODES, CASES)


def draw(cases, seed):
    """So many `Drawn`. A longer list begins with the same cases."""
    return several(_drawn, cases, seed)


def _drawn(chance, number):
    """One case: bodies and oil first, then a roughness for their film and their contact."""
    smooth = {
        "contact": _bodies(chance) | layers(chance),
        "lubricant": oil(chance),
        "motion": {"speed": by_logarithm(chance, *SPEED), "angle": _angle(chance)},
    }
    return finished(chance, number, smooth, surface_of, NODES, SHORTEST)


def _bodies(chance):
    """Radii, modulus and the load that presses smooth bodies as hard as was drawn."""
    modulus, pressure = modulus_and_pressure(chance)
    radius = by_logarithm(chance, *RADIUS)
    ratio = by_logarithm(chance, *RATIO) if chance.random() < 0.6 else 1.0
    bodies = {"radius_x": radius, "radius_y": ratio * radius, "reduced_modulus": modulus}
    return bodies | {"load": (pressure / p_h_of_one(bodies, "load")) ** 3}


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


def row(case, contact, result):
    """Text of one case, from its contact and its `Result`."""
    of_point = {
        "R_y/R_x": f"{contact.radius_y / contact.radius_x:.2f}",
        "angle": f"{case.tables['motion']['angle']:.0f}",
        "surface": finish(case.tables["surface"]),
    }
    return bodies(case, contact) | of_point | found(case, result)


def finish(surface):
    """A surface in a word or two."""
    if surface["kind"] == "waviness":
        ways = [name for name in "xy" if f"wavelength_{name}" in surface]
        return f"waves along {' and '.join(ways)}"
    return f"random {surface['aspect']:.0f}:1"
