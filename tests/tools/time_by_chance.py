"""Runs in time drawn by chance: what starts, stops, turns round, is loaded anew, or is rough and moves.

    python tests/tools/time_by_chance.py FIRST END     the seeds from FIRST to END - 1, a line for each

Balls on 65 nodes and lines on 257, steel to polymer, with and without layers. A seed that chose no constant
tells how often a run settles.
"""

import random
import sys
from math import pi
from pathlib import Path
from tempfile import TemporaryDirectory

import mgehl
from mgehl.errors import UserError

KINDS = "start", "stop", "reversal", "load", "rough", "both rough", "rough start"


def drawn(seed, folder):
    """(kind, settings) of a run; its tables of time are written into a folder."""
    chance = random.Random(seed)
    line, radius = chance.random() < 0.3, 10.0 ** chance.uniform(-2.5, -1.5)
    modulus = chance.choice([220e9, 110e9, 226e9, 4e9])
    p_h = 10.0 ** (chance.uniform(8.5, 9.3) if modulus > 1e10 else chance.uniform(7.3, 7.9))
    a = (4.0 if line else pi) * radius * p_h / modulus
    load = 0.5 * pi * p_h * a if line else 2.0 / 3.0 * pi * p_h * a**2
    speed, kind = 10.0 ** chance.uniform(-2.0, 0.3), chance.choice(KINDS)
    load_key = "contact.load_per_length" if line else "contact.load"
    time = a / speed
    settings = {
        "contact.kind": "line" if line else "point", "contact.radius_x": radius,
        "contact.reduced_modulus": modulus, load_key: load,
        "lubricant.viscosity": 10.0 ** chance.uniform(-2.0, -0.3),
        "lubricant.pressure_viscosity": chance.uniform(10e-9, 22e-9),
        "lubricant.viscosity_law": chance.choice(["barus", "roelands"]),
        "motion.speed": speed, "grid.nodes": 257 if line else 65, "grid.x": [-2.5, 2.5],
        "solver.start": "film", "time.end": 4.0 * time,
    } | ({} if line else {"contact.radius_y": radius, "grid.y": [-2.0, 2.0]})  # fmt: skip

    def course(*rows):
        path = folder / f"{seed}.csv"
        rows = *rows, (5.0, rows[-1][1])
        path.write_text("".join(f"{t * time},{value}\n" for t, value in rows))
        return str(path)

    within = chance.uniform(0.2, 3.0)
    if "start" in kind:
        settings["motion.speed"] = course((0.0, 0.0), (within, speed))
    elif kind in ("stop", "reversal"):
        settings["motion.speed"] = course((0.0, speed), (within, 0.0 if kind == "stop" else -speed))
    elif kind == "load":
        after = chance.choice([0.6, 1.5]) * load
        settings[load_key] = course((0.0, load), (0.1, load), (0.1 + within, after))
    if "rough" in kind:
        settings |= _rough(chance, seed, a, kind)
    return kind, settings


def _rough(chance, seed, a, kind):
    """Surfaces of one or both bodies, layers, and how much the bodies slide."""
    rms = 10.0 ** chance.uniform(-8.0, -6.7)
    ground = {"kind": "self-affine", "rms": rms}
    ground |= {"shortest_wavelength": 0.4 * a, "longest_wavelength": 2.0 * a}
    waves = {"kind": "waviness", "amplitude": 1.4 * rms, "wavelength_x": chance.uniform(0.3, 1.0) * a}
    first = chance.choice([ground | {"seed": seed}, waves]) | {"body": "body_1"}
    second = ground | {"seed": seed + 1, "body": "body_2"} if kind == "both rough" else {}
    return {
        **{f"surface.{key}": value for key, value in first.items()},
        **{f"second_surface.{key}": value for key, value in second.items()},
        "motion.slide_to_roll": 0.0 if "start" in kind else chance.choice([0.0, 0.2, -0.5, 1.0]),
        "contact.boundary_film": chance.choice([0.0, 2e-9]),
    }


def line_of(seed, folder):
    """What came of a seed."""
    kind, settings = drawn(seed, folder)
    try:
        solution = mgehl.solve(mgehl.load("/dev/null", settings))
    except UserError as refused:
        return f"{seed} {kind}: refused: {refused}"
    result, time = solution.result, solution.result.time
    work = f", {time.steps} steps, {time.halved} halved, {time.convolutions_a_step:.0f} convolutions each"
    how = "converged" if result.converged else f"NOT CONVERGED: {result.reason}"
    return f"{seed} {kind}, {settings['contact.kind']}: {how}{work if time else ''}"


if __name__ == "__main__":
    with TemporaryDirectory() as folder:
        for seed in range(*map(int, sys.argv[1:])):
            print(line_of(seed, Path(folder)), flush=True)
