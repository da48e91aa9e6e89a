"""Ellipses much wider than long: a line contact in the middle, an edge across the lines at the ends."""

from math import pi

import pytest

import mgehl
from mgehl.config import config_from_tables
from mgehl.kinds import contact_from

OIL = {"viscosity": 0.03, "pressure_viscosity": 18e-9}
RADIUS, MODULUS = 8e-3, 226e9


def contact(**how):
    bodies = {"radius_x": RADIUS, "reduced_modulus": MODULUS, **how}
    tables = {"contact": bodies, "lubricant": OIL, "motion": {"speed": 8.0}, "grid": {"nodes": 257}}
    return config_from_tables(tables | {"solver": {"error": False}})


def test_the_middle_of_a_wide_ellipse_is_the_line_contact_of_the_same_pressure():
    """22 times as wide as long. Torn nodes at both of its ends went in a circle, and it was not found."""
    wide = contact(load=3000.0, radius_y=0.9)
    per_length = 2.0 * pi * RADIUS * contact_from(wide).hertz.p_h ** 2 / MODULUS
    line = contact(kind="line", load_per_length=per_length)
    found, line = (mgehl.solve(each).result for each in (wide, line))
    assert found.converged and line.converged
    assert found.central_film_nm == pytest.approx(line.central_film_nm, rel=5e-3)
    assert found.minimum_film_nm == pytest.approx(line.minimum_film_nm, rel=5e-3)
