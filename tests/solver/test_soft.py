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
