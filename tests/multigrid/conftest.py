import pytest

from mgehl.discretization.bands import distributive_nodes
from mgehl.discretization.rows import PRESSURE, rows_of
from mgehl.discretization.scheme import Scheme
from mgehl.multigrid.smoother_choice import smoother_of

OMEGA = 0.8


@pytest.fixture(params=["1B", "2B"])
def jacobian(request, make_problem, rough_state, make_jacobian):
    """Of a state with contact, film and a cavity on 17 nodes a side."""
    problem = make_problem(nodes=17, coarsest=17, scheme=Scheme(couette=request.param))
    state = rough_state(problem, contact=True)
    jacobian = make_jacobian(problem, state)
    jacobian.rows = rows_of(state.status)
    return jacobian


@pytest.fixture
def masks(jacobian):
    """Of distributive nodes and of those whose pressure is not given."""
    eps, dX = jacobian.linearisation.eps, jacobian.grid.mesh.dX
    distributive = distributive_nodes(eps, jacobian.rows, dX, 0.4)
    assert 0.1 < distributive.mean() < 0.9
    return distributive, jacobian.rows != PRESSURE


@pytest.fixture
def make_smoother(in_the_end):
    """Factory of factored smoothers of a linearised `Jacobian` with these rows; freed after the test."""

    def make(jacobian, rows, kind=None):
        kind = kind or smoother_of(jacobian.grid.mesh.is_line, "1B", jacobian.holds_film)
        smoother = in_the_end(kind.free, kind(jacobian, OMEGA))
        smoother.partition(rows)
        smoother.factor()
        smoother.factor_alone()
        return smoother

    return make
