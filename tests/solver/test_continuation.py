import numpy as np
import pytest

import mgehl
from mgehl.discretization.scheme import Scheme
from mgehl.solver.continuation import Continuation
from mgehl.solver.nested import nested_iteration
from mgehl.solver.settings import SolverSettings
from mgehl.solver.task import Task


class Followed:
    """A `Continuation` with its settings and the levels it solved on."""

    def __init__(self, hierarchy, contact, scheme):
        self.told, self.scheme = [], scheme
        tell = lambda level, cycle: self.told.append(level)  # noqa: E731
        self._task = Task(hierarchy, contact, SolverSettings(scheme=scheme), tell)
        self.continuation = Continuation(self._task)

    def film(self):
        """Problem and `Outcome` at the contact's own speed."""
        return nested_iteration(self._task)

    @property
    def speeds(self):
        """Speeds on the finest grid, in the order they were solved at."""
        return list(dict.fromkeys(level.speed for level in self.told if level.finest))


@pytest.fixture
def make(make_hierarchy, paper_contact, usual_law):
    """Factory of `Followed` for the paper's contact on 65 nodes, made at 1 m/s."""

    def make(**scheme):
        contact = paper_contact()
        law = usual_law(contact)
        return Followed(make_hierarchy(contact, 65), contact, Scheme(**scheme, contact_law=law))

    return make


def true_residual(problem, state):
    state = problem.with_own_gap(state)
    return problem.rms(problem.residual(problem.evaluate(state), state.status))


def test_a_film_followed_to_another_speed_is_the_film_of_that_speed(make, solve, paper_contact):
    followed = make()
    _, first = followed.film()
    before = first.state.copy()
    problem, outcome = followed.continuation.follow(first.state, 1.0, 0.7)
    assert outcome.converged and problem.contact.speed == 0.7
    assert followed.speeds == [1.0, 0.7]
    expected = solve(paper_contact(0.7), 65).outcome.state
    np.testing.assert_allclose(outcome.state.P, expected.P, rtol=0.0, atol=1e-6)
    np.testing.assert_allclose(outcome.state.H, expected.H, rtol=0.0, atol=1e-6)
    np.testing.assert_array_equal(outcome.state.status, expected.status)
    # What was followed is not changed, and was another film.
    np.testing.assert_array_equal(first.state.P, before.P)
    np.testing.assert_array_equal(first.state.status, before.status)
    assert np.abs(first.state.P - expected.P).max() > 1e-2


def test_another_mean_is_found_from_the_logarithmic(make, solve, paper_contact):
    """65 nodes have not two cells in the inlet at 1 m/s: it is begun at a speed that has."""
    followed = make(face_mobility="geometric")
    problem, outcome = followed.continuation.begin()
    assert outcome.converged and problem.contact.speed == 1.0
    assert problem.scheme == followed.scheme
    assert true_residual(problem, outcome.state) <= 1e-8
    matched = paper_contact().matched_speed(problem.grid.mesh, 2.0)
    assert followed.speeds == [matched, 1.0] and matched > 1.0
    # Less fluid passes by the geometric mean: it takes a thicker film, by half on this grid.
    arithmetic = solve(paper_contact(), 65)
    central, _ = problem.films(outcome.state)
    assert central > 1.3 * arithmetic.problem.films(arithmetic.outcome.state)[0]


def test_a_stage_on_the_way_is_no_answer_of_its_own():
    """A geometric mean whose first stage may make no step: judged by its own equations, and said."""
    settings = {"grid.nodes": 65, "motion.speed": 1.2, "solver.start": "film", "solver.max_steps": 0}
    solution = mgehl.solve(mgehl.load(None, settings | {"discretization.face_mobility": "geometric"}))
    result = solution.result
    assert not result.settled and not result.converged
    assert "a stage on the way (logarithmic mean" in result.reason and "was not found: " in result.reason
    assert solution.contact.speed == 1.2
