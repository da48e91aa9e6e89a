import pytest

from mgehl.discretization.status import CAVITATED
from mgehl.solver.beyond import Beyond


@pytest.fixture
def problem(make_problem):
    return make_problem(nodes=33)


def test_what_is_torn_at_the_sides_resists_nothing(problem, rough_state):
    state, beyond = rough_state(problem, contact=False), Beyond(problem)
    beyond.resist(state, 0.1, 1.0)
    whole = problem.resistance
    upstream = state.copy()
    upstream.status[:, 1] = CAVITATED
    beyond.resist(upstream, 0.1, 1.0)
    assert 0.0 < problem.resistance < whole
    upstream.status[:] = CAVITATED
    beyond.resist(upstream, 0.1, 1.0)
    assert problem.resistance == 0.0


def test_bodies_that_part_suck_nothing_beyond_the_domain(problem, rough_state):
    """Film tears there as soon as it is sucked."""
    state = rough_state(problem, contact=False)
    Beyond(problem).resist(state, 0.1, 1.0)
    assert problem.squeezed_beyond(state.H0 - 1e-3) == pytest.approx(1e-3 * problem.resistance)
    assert problem.squeezed_beyond(state.H0 + 1e-3) == problem.resistance_at(state.H0 + 1e-3) == 0.0
