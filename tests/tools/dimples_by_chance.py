"""Textured contacts drawn by chance: ground land with dimples 3 to 30 times as deep as it is rough.

    python tests/tools/dimples_by_chance.py SEED CASES [NODES]    a line for each, and how many are found

Bodies, oils and land are those of `mgehl study machine`; dimples stand on a lattice that chance shifts.
"""

import sys
from tempfile import TemporaryDirectory

import numpy as np
from smooth_by_chance import solve_all

from mgehl.config import config_from_tables
from mgehl.kinds import contact_from, mesh_from
from mgehl.studies.chance import by_logarithm
from mgehl.studies.machine import LAMBDA, RMS, SHORTEST, drawn_bodies, self_affine, smooth_case
from mgehl.studies.study import merged

DEPTH = 3.0, 30.0
"""Over the rms height of the land."""
DIAMETER = 0.1, 0.5
"""Over the half-width of the smooth dry contact, at least `CELLS` cells."""
CELLS = 8.0
COVERED = 0.05, 0.4
"""Part of the surface that dimples take."""
POINTS = 1025


def drawn(seed, number, nodes, file):
    """The nested tables of a case, and what its bodies are; writes the dimples' heights to `file`."""
    chance = np.random.default_rng([seed, number])
    smooth = merged(smooth_case(chance, drawn_bodies(chance)), {"grid": {"nodes": nodes}})
    config = config_from_tables(smooth)
    contact = contact_from(config)
    cell = contact.longest_cell(mesh_from(config, contact))
    rms = float(np.clip(contact.expected_film / by_logarithm(chance, *LAMBDA), *RMS))
    land = self_affine(chance, number, rms, cell * by_logarithm(chance, *SHORTEST))
    diameter = max(by_logarithm(chance, *DIAMETER) * contact.hertz.a, CELLS * cell)
    depth, covered = rms * by_logarithm(chance, *DEPTH), by_logarithm(chance, *COVERED)
    dimples(chance, diameter, depth, covered, 8.0 * max(contact.hertz.a, contact.hertz.b), file)
    texture = {"file": file, "continuation": "periodic", "height_unit": "m", "position_unit": "m"}
    tables = smooth | {"surface": land, "second_surface": texture}
    what = f"{1e9 * depth:.0f} nm deep, {1e6 * diameter:.0f} um wide, {covered:.2f} of the surface"
    return tables, f"{1e-9 * smooth['contact']['reduced_modulus']:.0f} GPa, {what}"


def dimples(chance, diameter, depth, covered, size, file):
    """Write the heights, m, of cosine bowls in a square of this `size`."""
    apart = 0.5 * diameter * np.sqrt(np.pi / covered)
    count = max(1, round(size / apart))
    x = np.linspace(-0.5, 0.5, POINTS)[:-1] * size
    at = (np.arange(count) + chance.uniform(size=(2, 1))) * size / count - 0.5 * size
    away = [np.abs((x[:, None] - each + 0.5 * size) % size - 0.5 * size).min(axis=1) for each in at]
    r = np.minimum(np.hypot(away[0][None, :], away[1][:, None]) / (0.5 * diameter), 1.0)
    np.savez(file, heights=-0.5 * depth * (1.0 + np.cos(np.pi * r)), x=x, y=x)


def main(seed, cases, nodes=129):
    """Solve all; print them."""
    with TemporaryDirectory() as folder:
        every = (drawn(seed, number, nodes, f"{folder}/{number}.npz") for number in range(1, cases + 1))
        solve_all((what, tables) for tables, what in every)


if __name__ == "__main__":
    main(*(int(each) for each in sys.argv[1:]))
