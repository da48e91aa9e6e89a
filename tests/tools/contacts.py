"""Contacts of many tests, as nested tables: by Moes' numbers, lines, soft bodies; and films on twice the
domain."""

import csv
from pathlib import Path

import mgehl
from mgehl.config import config_from_tables
from mgehl.kinds import contact_from
from mgehl.model.starvation import Starvation
from mgehl.studies.study import BEST, merged

CONSTANT = {"lubricant": {"density_law": "constant"}}
MY_CASE = {"contact": {"load": 250.0, "radius_x": 10e-3, "radius_y": 15e-3}}
BALL_BEARING = {
    "contact": {"load": 300.0, "radius_x": 3.8e-3, "radius_y": 124e-3, "reduced_modulus": 226e9},
    "lubricant": {"viscosity": 0.02, "pressure_viscosity": 20e-9},
    "motion": {"speed": 3.0},
}
ELLIPSE = {"contact": {"load": 300.0, "radius_x": 10e-3, "radius_y": 83e-3}, "motion": {"speed": 0.5}}

MODULUS, RADIUS, VISCOSITY, PRESSURE_VISCOSITY = 8e9, 10e-3, 0.05, 12e-9
"""Of polymer on steel in a thin oil; SI."""


def solved(*tables, start=None):
    """The `Solution` of nested tables, later ones first in authority."""
    return mgehl.solve(config_from_tables(merged(*tables)), start=start)


def contact_of(*tables):
    """Their contact."""
    return contact_from(config_from_tables(merged(*tables)))


def starvation(*tables):
    """What a domain takes of their film."""
    contact = contact_of(*tables)
    return Starvation(contact, contact.flooded_film)


def moes(M, L, **contact):
    """A point contact by Moes' numbers, incompressible."""
    return merged(CONSTANT, {"moes": {"M": M, "L": L}, "contact": contact})


def line(load, speed):
    """A line contact of the paper's body."""
    return {"contact": {"kind": "line", "load_per_length": load}, "motion": {"speed": speed}}


def soft(kind, M, L, ratio=1.0):
    """A soft "line" or "point" contact by its Moes numbers, on the domain of "auto"."""
    two_U = (L / (PRESSURE_VISCOSITY * MODULUS)) ** 4
    if kind == "line":
        load = {"load_per_length": M * two_U**0.5 * MODULUS * RADIUS}
    else:
        load = {"load": M * two_U**0.75 * MODULUS * RADIUS**2, "radius_y": ratio * RADIUS}
    return {
        "contact": {"kind": kind, "radius_x": RADIUS, "reduced_modulus": MODULUS, **load},
        "lubricant": {
            "viscosity": VISCOSITY, "pressure_viscosity": PRESSURE_VISCOSITY, "density_law": "constant",
        },
        "motion": {"speed": 0.5 * two_U * MODULUS * RADIUS / VISCOSITY},
        "grid": {"nodes": {"line": 513, "point": 129}[kind]},
        "discretization": BEST,
    }  # fmt: skip


BALLS = (
    (5.0, 5.0), (2.0, 4.0), (3.0, 2.0), (8.0, 3.0), (12.0, 8.0), (20.0, 10.0), (60.0, 2.0), (200.0, 14.0),
    (1000.0, 6.0), (5000.0, 10.0),
)  # fmt: skip
"""M, L."""

ON_TWICE_THE_DOMAIN = {
    "my.toml, 0.4 m/s": merged(MY_CASE, {"motion": {"speed": 0.4}}),
    "my.toml, 3 m/s": merged(MY_CASE, {"motion": {"speed": 3.0}}),
    "my.toml, 3 m/s, Roelands": merged(
        MY_CASE, {"motion": {"speed": 3.0}, "lubricant": {"viscosity_law": "roelands"}}
    ),
    "ball bearing": BALL_BEARING,
    **{f"M {M:g}, L {L:g}": moes(M, L) for M, L in BALLS},
    "M 5, L 5, fewer nodes": moes(5.0, 5.0),
    "M 5, L 5, 10:1": moes(5.0, 5.0, radius_x=5e-3, radius_y=50e-3),
    "M 100, L 8, 1:4": moes(100.0, 8.0, radius_x=20e-3, radius_y=5e-3),
    "M 100, L 8, 8:1": moes(100.0, 8.0, radius_x=5e-3, radius_y=40e-3),
    "ball at 45 degrees": {"motion": {"speed": 1.0, "angle": 45.0}},
    "ellipse at 30 degrees": merged(ELLIPSE, {"motion": {"angle": 30.0}}),
    "ellipse at 110 degrees": merged(ELLIPSE, {"motion": {"angle": 110.0}}),
    "line, 50 N/mm, 1 m/s": line(50e3, 1.0),
    "line, 20 N/mm, 1 m/s": line(20e3, 1.0),
    "line, 1859 N/mm, 3 m/s": line(1859e3, 3.0),
}
"""Contacts that were solved on the domain that mgehl chooses, on two nearer ones, and on twice each."""


def films_on_twice_the_domain():
    """What twice a domain changed in the film, in per cent, and what was estimated of it: rows of text."""
    with Path(__file__).with_name("twice_the_domain.csv").open() as file:
        return list(csv.DictReader(file))
