import numpy as np
import pytest
from scipy import sparse

from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CAVITATED, CONTACT
from mgehl.multigrid.coarse import CoarseSolve, DenseInverse

NODES = 33


@pytest.fixture
def states(solve, paper_contact):
    """Solutions on the coarsest grid: a film at 3 m/s, and full contact at 0.005 mm/s."""
    film = solve(paper_contact(3.0), NODES)
    mixed = solve(paper_contact(5e-6), NODES, start="contact")
    assert not np.any(film.outcome.state.status == CONTACT)
    assert np.any(mixed.outcome.state.status == CONTACT)
    assert np.any(mixed.outcome.state.status == CAVITATED)
    return {"film": film.outcome.state, "contact": mixed.outcome.state}


@pytest.fixture
def invert(make_vec):
    """Function: solve J x = J random; check that J x is that, and return x and the random vector."""

    def run(problem, jacobian, coarse):
        space = jacobian.space
        P = np.where(problem.boundary, 0.0, np.random.default_rng(8).standard_normal(problem.grid.shape))
        x, y = make_vec(space, P, 0.4), make_vec(space)
        jacobian.mat.mult(x, y)
        coarse.gather()
        coarse.factor()
        solved = make_vec(space, *coarse.solve(*space.read(y)))
        jacobian.mat.mult(solved, x)
        x.axpy(-1.0, y)
        assert x.norm() < 1e-12 * y.norm()
        return space.read(solved), (P, 0.4)

    return run


def assert_same(result, expected):
    """To what the condition leaves: mobilities differ by fifteen orders of magnitude."""
    (P, H0), (expected_P, expected_H0) = result, expected
    np.testing.assert_allclose(P, expected_P, rtol=0.0, atol=1e-7)
    assert H0 == pytest.approx(expected_H0, abs=1e-7)


@pytest.mark.parametrize("couette, motion", [("1B", (1.0, 0.0)), ("2B", (0.8, 0.6)), ("S1B", (1.0, 0.0))])
@pytest.mark.parametrize("kind", ["film", "contact"])
def test_it_inverts_the_jacobian(make_problem, states, make_jacobian, invert, couette, motion, kind):
    problem = make_problem(nodes=NODES, scheme=Scheme(couette, motion=motion))
    jacobian = make_jacobian(problem, states[kind])
    assert_same(*invert(problem, jacobian, CoarseSolve(jacobian)))


def test_it_follows_the_linearisation(make_problem, states, make_jacobian, invert):
    """Set up again after the Jacobian was linearised about another state."""
    problem = make_problem(nodes=NODES)
    jacobian = make_jacobian(problem, states["film"])
    coarse = CoarseSolve(jacobian)
    coarse.gather()
    coarse.factor()
    state = states["contact"]
    jacobian.linearise(problem.evaluate(state), problem.rows(state.status))
    assert_same(*invert(problem, jacobian, coarse))


@pytest.mark.parametrize("bent", [False, True])
def test_what_single_precision_does_not_give_back_is_solved_in_doubles(bent):
    """A string, and a plate of condition 1e9: rollers that were solved so were not found."""
    n = 200
    string = sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(n, n), format="csr")
    A, nothing = string @ string if bent else string + sparse.identity(n, format="csr"), np.zeros(n, bool)
    stiffness = A, sparse.identity(n, format="csr"), np.zeros((n, n))
    masks, room = (nothing, np.ones(n)), lambda precision: np.empty((n + 1) ** 2, precision)
    inverse = DenseInverse(*stiffness, (0.5, 0.3), *masks, room)
    known = np.random.default_rng(3).standard_normal(n + 1)
    right = np.append(A @ known[:-1] + known[-1], 0.5 * known[:-1].sum() - 0.3 * known[-1])
    np.testing.assert_allclose(inverse(right), known, rtol=0.0, atol=1e-6 if bent else 1e-12)
