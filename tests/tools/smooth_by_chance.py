"""Smooth contacts drawn by chance, most at speeds whose film the grid hardly sees.

    python tests/tools/smooth_by_chance.py SEED CASES     a line for each, and how many are found

Points and ellipses on 65 and 129 nodes, lines on 257 and 513; steel to polymer; from a film or from
contact. A seed that chose no constant tells how often a film is found, and what of the oil nodes make.
"""

import sys

import numpy as np

import mgehl
from mgehl.config import config_from_tables
from mgehl.studies.chance import by_logarithm
from mgehl.studies.machine import RADIUS, RATIO, modulus_and_pressure, p_h_of_one, smooth_case

SPEED = 1e-4, 3.0


def drawn(seed, number):
    """The nested tables of a case."""
    chance = np.random.default_rng([seed, number])
    modulus, pressure = modulus_and_pressure(chance)
    line, radius = chance.random() < 0.3, by_logarithm(chance, *RADIUS)
    bodies = {"radius_x": radius, "reduced_modulus": modulus}
    if line:
        bodies |= {"kind": "line"}
        load, power = "load_per_length", 2
    else:
        bodies["radius_y"] = radius * (by_logarithm(chance, *RATIO) if chance.random() < 0.6 else 1.0)
        load, power = "load", 3
    bodies[load] = (pressure / p_h_of_one(bodies, load)) ** power
    tables = smooth_case(chance, bodies)
    del tables["contact"]["boundary_film"]
    tables["motion"] = {"speed": by_logarithm(chance, *SPEED)}
    if not line and chance.random() < 0.3:
        tables["motion"]["angle"] = float(chance.uniform(5.0, 85.0))
    tables["grid"] = {"nodes": int(chance.choice((257, 513) if line else (65, 129)))}
    start = str(chance.choice(("film", "film", "contact")))
    return tables | {"solver": {"start": start, "error": False}}


def solve_all(cases):
    """Solve the (words, nested tables) of all; print a line for each, and how many are found."""
    found = number = 0
    for number, (what, tables) in enumerate(cases, 1):
        result = mgehl.solve(config_from_tables(tables)).result
        found += result.converged
        print(
            f"{number}: {what}: {result.resolution.inlet_cells:.2f} cells, film "
            f"{result.central_film_nm:.4g} nm, contact {result.contact.load_fraction:.2f} of the load, "
            f"{result.work.convolutions:.0f} convolutions, made {result.mass.made_share:.1e}"
            f"{'' if result.converged else f': {result.reason}'}",
            flush=True,
        )
    print(f"{found} of {number} found")


def main(seed, cases):
    """Solve all; print them."""
    every = (drawn(seed, number) for number in range(1, cases + 1))
    solve_all((_words(tables), tables) for tables in every)


def _words(tables):
    speed, nodes = tables["motion"]["speed"], tables["grid"]["nodes"]
    return f"{speed:.2g} m/s, {nodes} nodes from {tables['solver']['start']}"


if __name__ == "__main__":
    main(*(int(each) for each in sys.argv[1:]))
