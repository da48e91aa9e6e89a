"""The direct solve on the coarsest grid."""

import numpy as np
import pytest
from scipy.sparse import random as random_sparse

from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CAVITATED, CONTACT
from mgehl.multigrid.coarse import CoarseSolve, dense_influence, fill_bordered

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
@pytest.mark.parametrize("rigid", [False, True], ids=["elastic", "rigid"])
def test_it_inverts_the_jacobian(make_problem, states, make_jacobian, invert, couette, motion, kind, rigid):
    problem = make_problem(nodes=NODES, scheme=Scheme(couette, motion=motion))
    jacobian = make_jacobian(problem, states[kind], rigid)
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


def test_dense_influence_is_the_convolution(make_problem):
    problem = make_problem(nodes=NODES)
    P = np.where(problem.boundary, 0.0, np.random.default_rng(9).random(problem.grid.shape))
    K = dense_influence(problem.grid.mesh, problem.contact.kernel)
    expected = problem.deflection(P)
    np.testing.assert_allclose((K @ P.ravel()).reshape(P.shape), expected, rtol=0.0, atol=1e-13)


def test_the_dense_matrix_is_the_jacobian_of_the_free_nodes():
    rng, nodes = np.random.default_rng(5), 12
    A, B = (random_sparse(nodes, nodes, 0.3, "csr", random_state=rng) for _ in range(2))
    K, free = rng.random((nodes, nodes)), np.array([0, 3, 4, 7, 11])
    matrix = np.full((6, 6), np.nan)
    rows = [(each.indptr, each.indices, each.data) for each in (A[free], B[free])]
    fill_bordered(matrix, free, np.ones(len(K)), *rows, K, 0.7)
    expected = (A + B @ K)[np.ix_(free, free)]
    np.testing.assert_allclose(matrix[:-1, :-1], expected, rtol=1e-14)
    np.testing.assert_allclose(matrix[:-1, -1], np.ravel(B[free].sum(axis=1)), rtol=1e-14)
    np.testing.assert_array_equal(matrix[-1], [0.7] * 5 + [0.0])
