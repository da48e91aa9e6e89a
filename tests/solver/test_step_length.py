"""How long a Newton step may be."""

import numpy as np
import pytest

from mgehl.discretization.contact_law import BoundaryFilm
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.model.lubricant import Barus, DowsonHigginson, Lubricant
from mgehl.solver.partition import Partition
from mgehl.solver.step_length import LARGEST_CHANGE, MOST_MORE, STEEP, step_length


@pytest.fixture
def stiff(make_problem):
    """Problem, partition, evaluation and a state: a film of 0.01 so stiff that no pressure drives it."""
    scheme = Scheme(face_mobility="linear-gap", contact_law=BoundaryFilm(1e-3))
    problem = make_problem(nodes=9, scheme=scheme)
    P, status = np.full((9, 9), 2.0), np.full((9, 9), LUBRICATED)
    state = problem.state(P, 0.0, status)
    problem.gap = lambda P, H0: np.full((9, 9), 0.01 + H0)  # as if no pressure bent anything
    state.H[:] = 0.01
    return problem, Partition(problem, 0), problem.evaluate(state), state


@pytest.mark.parametrize(
    "times, expected", [(0.25, 1.0), (1.0, LARGEST_CHANGE), (2.0, LARGEST_CHANGE / 2.0)]
)
def test_a_film_changes_by_half_of_itself_at_the_most(stiff, times, expected):
    length, H, dH = step_length(*stiff, np.zeros((9, 9)), times * 0.01, 0.5)
    assert length == pytest.approx(expected)
    assert (H is None) == (expected < 1.0)
    np.testing.assert_allclose(dH, times * 0.01, rtol=1e-12)  # of a whole step, whatever is taken


def test_what_is_no_film_does_not_count(stiff):
    """Half of the film in contact, whose gap a step may change as it will."""
    state = stiff[-1]
    state.status[1:5, 1:-1], state.H[1:5, 1:-1] = CONTACT, 1e-3
    length, *_ = step_length(*stiff, np.zeros((9, 9)), 0.01, 0.5)
    assert length == pytest.approx(0.5)


def test_the_largest_pressure_is_bounded_by_any_law(make_problem):
    problem = make_problem(nodes=9)
    state = problem.state(np.full((9, 9), 2.0), 1.0, np.full((9, 9), LUBRICATED))
    dP = np.zeros((9, 9))
    dP[4, 4] = -2.0
    known = problem, Partition(problem, 0), problem.evaluate(state), state
    assert step_length(*known, dP, 9.0, 0.5) == (0.25, None, None)


@pytest.mark.parametrize(
    "alpha_bar, more", [(40.0, 1.0), (STEEP, 1.0), (STEEP / 1.5, 1.5), (0.0, MOST_MORE)]
)
def test_pressures_change_by_more_where_the_viscosity_is_less_steep(
    make_problem, paper_contact, alpha_bar, more
):
    alpha = alpha_bar / paper_contact().pressure_scale
    contact = paper_contact(lubricant=Lubricant(Barus(0.096, alpha), DowsonHigginson()))
    problem = make_problem(contact, nodes=9)
    state = problem.state(np.full((9, 9), 0.2), 1.0, np.full((9, 9), LUBRICATED))
    known = problem, Partition(problem, 0), problem.evaluate(state), state
    length, *_ = step_length(*known, np.full((9, 9), 4.0), 0.0, 0.3)
    assert length == pytest.approx(min(1.0, more * 0.3 / 4.0), rel=1e-12)
