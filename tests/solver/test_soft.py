"""Films of bodies that yield to pressures which hardly stiffen the oil."""

import pytest
from mpi4py import MPI
from tools.contacts import soft

from mgehl.config import config_from_tables
from mgehl.run import solve


def solved(kind, M, L, ratio=1.0):
    """The solution of a soft contact by Moes' numbers."""
    tables = soft(kind, M, L, ratio)
    return solve(config_from_tables(tables | {"solver": {"error": False}}), MPI.COMM_SELF)


@pytest.mark.parametrize("L", [0.3, 0.8])
@pytest.mark.parametrize("M", [5.0, 30.0, 100.0])
def test_lines_converge_to_moes_film(M, L):
    """One of six did, by steps that closed the film and a relaxation that took the load away."""
    solution = solved("line", M, L)
    result = solution.result
    assert result.converged and result.work.convolutions < 110.0
    assert 1e-9 * result.central_film_nm == pytest.approx(solution.contact.flooded_film, rel=0.15)


@pytest.mark.parametrize("M, L, ratio", [(50.0, 0.5, 1.0), (200.0, 0.8, 4.0)])
def test_points_converge_to_moes_film(M, L, ratio):
    solution = solved("point", M, L, ratio)
    result = solution.result
    assert result.converged and result.work.convolutions < 110.0
    assert 1e-9 * result.central_film_nm == pytest.approx(solution.contact.flooded_film, rel=0.25)


WIDE = {
    "contact": {"radius_x": 22e-3, "radius_y": 114e-3, "reduced_modulus": 4e9, "load": 735.0},
    "lubricant": {"viscosity": 0.13, "pressure_viscosity": 12e-9, "viscosity_law": "roelands"},
    "motion": {"speed": 0.1, "angle": 6.0},
}
"""Polymer on a wide roller, M = 5000: 0.065 GPa."""


def test_a_wide_contact_has_a_film():
    """By contact that closes its faces there was none: what had closed on the way stayed closed."""
    result = solve(config_from_tables(WIDE | {"solver": {"error": False}}), MPI.COMM_SELF).result
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
        "solver": {"error": False},
    }
    result = solve(config_from_tables(tables), MPI.COMM_SELF).result
    assert result.converged and result.work.convolutions < 800.0
    assert result.mixed.lambda_ratio < 0.5
