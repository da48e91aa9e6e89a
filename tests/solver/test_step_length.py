"""How long a Newton step may be."""

import numpy as np
import pytest

from mgehl.discretization.contact_law import BoundaryFilm
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.solver.step_length import LARGEST_CHANGE, step_length


@pytest.fixture
def stiff(make_problem):
    """Problem, its evaluation and a state: a film of 0.01 so stiff that no pressure drives it."""
    scheme = Scheme(face_mobility="linear-gap", contact_law=BoundaryFilm(1e-3))
    problem = make_problem(nodes=9, scheme=scheme)
    state = problem.state(np.full((9, 9), 2.0), 0.0, np.full((9, 9), LUBRICATED))
    state.H[:] = 0.01
    return problem, problem.evaluate(state), state


@pytest.mark.parametrize(
    "times, expected", [(0.25, 1.0), (1.0, LARGEST_CHANGE), (2.0, LARGEST_CHANGE / 2.0)]
)
def test_a_film_changes_by_half_of_itself_at_the_most(stiff, times, expected):
    problem, evaluation, state = stiff
    nothing = np.zeros((9, 9))
    assert step_length(problem, evaluation, state, nothing, times * 0.01, 0.5) == pytest.approx(expected)


def test_what_is_no_film_does_not_count(stiff):
    """Half of the film in contact, whose gap a step may change as it will."""
    problem, evaluation, state = stiff
    state.status[1:5, 1:-1], state.H[1:5, 1:-1] = CONTACT, 1e-3
    assert step_length(problem, evaluation, state, np.zeros((9, 9)), 0.01, 0.5) == pytest.approx(0.5)


def test_the_largest_pressure_is_bounded_by_any_law(make_problem):
    problem = make_problem(nodes=9)
    state = problem.state(np.full((9, 9), 2.0), 1.0, np.full((9, 9), LUBRICATED))
    dP = np.zeros((9, 9))
    dP[4, 4] = -2.0
    assert step_length(problem, problem.evaluate(state), state, dP, 9.0, 0.5) == 0.25
