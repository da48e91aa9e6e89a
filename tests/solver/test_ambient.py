"""Oil that has a pressure all around the contact: P is what comes on top, and film tears below it."""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.config import load_config
from mgehl.discretization.status import CAVITATED
from mgehl.run import solve

AROUND = 5e7
BALL = {
    "contact.load": 20.0, "lubricant.viscosity": 0.096, "lubricant.pressure_viscosity": 18.2e-9,
    "grid.nodes": 65, "grid.x": [-2.5, 2.0], "grid.y": [-2.0, 2.0], "solver.error": False,
}  # fmt: skip


def solved(**settings):
    return solve(load_config(None).with_(BALL | settings), MPI.COMM_SELF)


def at_rest(speed, ambient):
    return solved(**{
        "motion.speed": speed, "contact.boundary_film": 2e-9, "solver.start": "contact",
        "contact.ambient_pressure": ambient,
    })  # fmt: skip


def test_oil_under_a_ball_at_rest_has_the_pressure_around_it():
    """What presses is that of the dry contact, and the oil in the layers is at the ambient pressure: what
    the motion adds vanishes with it."""
    bare, *slower = at_rest(1e-9, 0.0), at_rest(1e-9, AROUND), at_rest(1e-10, AROUND)
    added = []
    for solution in slower:
        fields, result = solution.fields, solution.result
        assert result.converged and result.pressure_inequality.violations == 0
        assert result.contact.load_fraction == pytest.approx(1.0, abs=1e-6)
        np.testing.assert_allclose(fields.P, bare.fields.P, atol=1e-6)
        added.append(np.abs(fields.p).max())
    assert added[1] == pytest.approx(0.1 * added[0], rel=1e-3) and added[1] < 1e-6


def test_without_tearing_a_pressure_around_is_a_thicker_oil():
    """Barus's law from p0 on is that of the viscosity at p0."""
    film = {"motion.speed": 0.5, "solver.start": "film", "lubricant.density_law": "constant"}
    film |= {"discretization.cavitation": False, "solver.tolerance": 1e-10}
    thicker = float(BALL["lubricant.viscosity"] * np.exp(BALL["lubricant.pressure_viscosity"] * AROUND))
    one = solved(**film, **{"contact.ambient_pressure": AROUND})
    other = solved(**film, **{"lubricant.viscosity": thicker})
    np.testing.assert_allclose(one.fields.P, other.fields.P, atol=1e-8)
    assert one.result.central_film_nm == pytest.approx(other.result.central_film_nm, rel=1e-9)
    assert one.contact.shown_formulas == pytest.approx(other.contact.shown_formulas)


def test_the_film_tears_where_nothing_is_left_of_the_pressure_around():
    """Behind the contact P falls below zero: as far as that, or, under much pressure, not so far."""
    film = {"motion.speed": 0.5, "solver.start": "film"}
    little, much = (solved(**film, **{"contact.ambient_pressure": p}) for p in (0.2 * AROUND, AROUND))
    assert little.result.converged and much.result.converged
    torn = little.fields.status == CAVITATED
    assert torn.any() and np.all(little.fields.P[torn] == little.contact.tears_at)
    assert little.fields.P.min() == little.contact.tears_at < 0.0
    assert not np.any(much.fields.status == CAVITATED)
    assert much.contact.tears_at < much.fields.P.min() < little.fields.P.min()


SEAL = {
    "contact.kind": "line", "contact.load_per_length": 1000.0, "contact.radius_x": 0.01,
    "contact.reduced_modulus": 226e9, "contact.ambient_pressure": 1e6, "lubricant.viscosity": 0.05,
    "motion.speed": 0.05, "grid.x": "auto", "grid.nodes": 513, "solver.start": "film",
    "solver.error": False,
}  # fmt: skip


def test_the_domain_holds_the_suction_behind_a_light_load():
    """Film on a domain of its own choice and, by cells as large, on one twice as long; one that ends early
    starves it."""

    def on(x, nodes):
        return solve(load_config(None).with_(SEAL | {"grid.x": x, "grid.nodes": nodes}), MPI.COMM_SELF)

    chosen = on("auto", 513)
    first, last = chosen.config.grid.x
    wide, short = on([2.0 * first, 2.0 * last], 1025), on([first, 0.05 * last], 513)
    assert chosen.result.resolution.domain == "sufficient"
    assert chosen.result.central_film_nm == pytest.approx(wide.result.central_film_nm, rel=3e-3)
    assert short.result.resolution.domain == "starved"
    assert short.result.central_film_nm > 1.05 * wide.result.central_film_nm
