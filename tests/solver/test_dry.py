"""The dry contact of layered bodies."""

import numpy as np
import pytest

from mgehl.discretization.status import LUBRICATED
from mgehl.model.coating import Coating
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
