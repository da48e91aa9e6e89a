"""Films of bodies that yield to pressures which hardly stiffen the oil."""

import pytest
from contacts import soft, solved

NO_ERROR = {"solver": {"error": False}}
LINES = [("line", M, L, 1.0) for M in (5.0, 30.0, 100.0) for L in (0.3, 0.8)]
POINTS = [("point", 50.0, 0.5, 1.0), ("point", 200.0, 0.8, 4.0)]


@pytest.mark.parametrize("kind, M, L, ratio", [*LINES, *POINTS])
def test_they_converge_to_moes_film(kind, M, L, ratio):
    """One of six lines did, by steps that closed the film and a relaxation that took the load away."""
    solution, within = solved(soft(kind, M, L, ratio), NO_ERROR), {"line": 0.15, "point": 0.25}[kind]
    result = solution.result
    assert result.converged and result.work.convolutions < 110.0
    assert 1e-9 * result.central_film_nm == pytest.approx(solution.contact.flooded_film, rel=within)


WATER = {
    "contact": {"kind": "line", "radius_x": 32.2e-3, "reduced_modulus": 20e6},
    "lubricant": {"viscosity": 4.11e-3, "pressure_viscosity": 0.0, "density_law": "constant"},
    "motion": {"speed": 2.456}, "grid": {"nodes": 513},
}  # fmt: skip
"""Of a rubber roller, no thicker than blood."""


@pytest.mark.parametrize("layers", [0.0, "2 nm"])
def test_rubber_in_water(layers):
    """M = 76: on 65 nodes Newton's own steps went in a circle, and 2500 convolutions led nowhere."""
    pressed = {"contact": {"load_per_length": 8694.0, "boundary_film": layers}}
    solution = solved(WATER, pressed, NO_ERROR)
    result = solution.result
    assert result.converged and result.work.convolutions < 200.0
    assert 1e-9 * result.central_film_nm == pytest.approx(solution.contact.flooded_film, rel=0.05)


def test_a_rigid_roller_in_water_has_martins_film():
    """4.896 eta u R/w of each metre: 0.2 % of the load is carried beyond the domain."""
    result = solved(WATER, {"contact": {"load_per_length": 10.0}}, NO_ERROR).result
    assert result.converged and result.resolution.verdict == "resolved" and result.work.convolutions < 80.0
    martin = 4.896 * 4.11e-3 * 2.456 * 32.2e-3 / 10.0
    assert 1e-9 * result.central_film_nm == pytest.approx(martin, rel=3e-3)


WIDE = {
    "contact": {"radius_x": 22e-3, "radius_y": 114e-3, "reduced_modulus": 4e9, "load": 735.0},
    "lubricant": {"viscosity": 0.13, "pressure_viscosity": 12e-9, "viscosity_law": "roelands"},
    "motion": {"speed": 0.1, "angle": 6.0},
}
"""Polymer on a wide roller, M = 5000: 0.065 GPa."""


def test_a_wide_contact_has_a_film():
    """By contact that closes its faces there was none: what had closed on the way stayed closed."""
    result = solved(WIDE, NO_ERROR).result
    assert result.converged and result.contact.nodes == 0 and result.work.convolutions < 140.0
    assert result.central_film_nm == pytest.approx(387.0, rel=0.01)


def test_ridges_along_the_motion_on_a_soft_ball():
    """At the gap of the second step the relaxation took two thirds of the load away."""
    tables = {
        "contact": {"radius_x": 3.4e-3, "radius_y": 3.4e-3, "reduced_modulus": 4e9, "load": 1.2},
        "lubricant": {"viscosity": 0.042, "pressure_viscosity": 16e-9},
        "motion": {"speed": 0.048},
        "surface": {"kind": "waviness", "amplitude": 0.33e-6, "wavelength_y": 31e-6},
        "grid": {"nodes": 129},
    }
    result = solved(tables, NO_ERROR).result
    assert result.converged and result.work.convolutions < 800.0
    assert result.mixed.lambda_ratio < 0.5
