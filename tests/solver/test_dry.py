"""The dry contact of layered bodies."""

import numpy as np
import pytest

from mgehl.discretization.status import LUBRICATED
from mgehl.model.coating import Coating
from mgehl.model.surface import Waviness
from mgehl.solver.dry import dry_pressure
from mgehl.solver.nested import first_guess


def coating(contact, modulus, thickness):
    """On one of two steel bodies; `thickness` in units of a."""
    return Coating(thickness * contact.hertz.a, modulus, 0.3, None, 0.3, contact.reduced_modulus)


@pytest.fixture
def problem(paper_contact, make_problem):
    """Function: the paper's ball with a coating."""

    def make(modulus, thickness):
        bare = paper_contact()
        contact = paper_contact(deformation=coating(bare, modulus, thickness))
        return make_problem(contact, nodes=65, x=(-2.1, 2.1), y=(-2.1, 2.1))

    return make


def test_half_spaces_find_hertz_from_a_bad_guess(make_problem):
    problem = make_problem(nodes=65)
    grid = problem.grid
    P = dry_pressure(problem, np.where(grid.X**2 + grid.Y**2 < 0.6, 1.0, 0.0))
    hertz = problem.contact.guessed_pressure(grid.X, grid.Y)
    assert np.abs(P - hertz).max() < 0.12  # at the edge, within a cell
    assert np.abs(P - hertz)[hertz > 0.5].max() < 0.01


@pytest.mark.parametrize("modulus", [4e9, 50e9, 800e9])
def test_pressed_nodes_touch_and_the_others_are_apart(problem, modulus):
    problem = problem(modulus, 0.3)
    grid = problem.grid
    P = dry_pressure(problem, problem.contact.guessed_pressure(grid.X, grid.Y))
    assert problem.load_deficit(P) == pytest.approx(0.0, abs=1e-12)
    assert (P >= 0.0).all() and not P[problem.boundary].any()
    gap = problem.gap(P, problem.touching(P))
    scale = np.ptp(gap)
    assert np.abs(gap[P > 0.0]).max() < 2e-3 * scale
    assert gap[P == 0.0].min() > -2e-3 * scale


def test_a_film_starts_from_it_with_the_thickness_that_is_expected(problem):
    problem = problem(4e9, 0.3)
    state = first_guess(problem, "film")
    pressed = state.P > 0.0
    film = problem.contact.expected_film / problem.contact.film_scale
    assert state.H[pressed].min() == pytest.approx(film, rel=1e-12)
    assert np.ptp(state.H[pressed]) < 0.2 * film
    assert (state.status[~problem.boundary] == LUBRICATED).all()
    # A soft layer is thought of as half-spaces that are as wide: a thicker film than on steel.
    assert problem.contact.expected_film > 1.05 * problem.contact.formulas.hamrock_dowson_central


A = 0.4108333e-3
"""Hertz radius of the paper's ball in m."""


@pytest.mark.parametrize(
    "amplitude, wavelength_y, nodes, p_max",
    [
        (50e-9, A / 2, 5403, 2.383120),
        (200e-9, A / 2, 5409, 2.742123),
        (1e-6, A / 2, 4399, 4.630775),
        (200e-9, None, 5421, 2.599292),
    ],
    ids=["wavy 50 nm", "wavy 200 nm", "wavy 1 um", "ridge 200 nm"],
)
def test_a_wavy_ball_is_pressed_as_a_public_code_has_it(
    paper_contact, make_problem, monkeypatch, amplitude, wavelength_y, nodes, p_max
):
    """ContactMechanics 1.8.3 with the same rectangles: nodes in contact and the largest pressure in GPa.

    A peak is in the middle: with the other sign the pressure there would be lower than that of Hertz.
    """
    monkeypatch.setattr("mgehl.solver.dry.TOLERANCE", 1e-10)
    monkeypatch.setattr("mgehl.solver.dry.MAX_STEPS", 1000)
    contact = paper_contact(surface=Waviness(amplitude, A / 2, wavelength_y))
    problem = make_problem(contact, nodes=129)
    P = dry_pressure(problem, contact.guessed_pressure(problem.grid.X, problem.grid.Y))
    assert np.count_nonzero(P) == nodes
    assert 1e-9 * contact.hertz.p_h * P.max() == pytest.approx(p_max, rel=1e-6)
