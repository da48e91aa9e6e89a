"""The distributive line smoother as an iteration of its own."""

import numpy as np
import pytest

from mgehl.discretization.bands import distributive_nodes
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.rows import FLOW, GAP, PRESSURE, rows_of
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, CAVITATED, LUBRICATED
from mgehl.multigrid.smoother import CrossedLineSmoother, LineSmoother, RigidLineSmoother, smoother_of

NODES, OMEGA = 65, 0.8


@pytest.fixture
def make_smoother():
    """Factory of factored smoothers of a linearised `Jacobian` with these rows; freed after the test."""
    made = []

    def make(jacobian, rows, kind=None):
        made.append((kind or smoother_of(jacobian))(jacobian, OMEGA))
        made[-1].partition(rows)
        made[-1].factor()
        return made[-1]

    yield make
    for smoother in made:
        smoother.free()


@pytest.fixture
def film(solve, paper_contact):
    """The solved full film at 1 m/s."""
    return solve(paper_contact(), NODES)


@pytest.fixture(params=[LineSmoother, CrossedLineSmoother])
def relax(request, film, make_jacobian, make_smoother, make_vec):
    """Function: norms of error and residual after 0, 1, 2 ... relaxations of J e = 0."""
    state = film.outcome.state
    jacobian = make_jacobian(film.problem, state)
    smoother = make_smoother(jacobian, film.problem.rows(state.status), request.param)

    def run(error, relaxations):
        P, r = error.copy(), make_vec(jacobian.space)
        errors, residuals = [], []
        for _ in range(relaxations + 1):
            jacobian.mat.mult(make_vec(jacobian.space, P), r)
            errors.append(np.linalg.norm(P))
            residuals.append(r.norm())
            P -= smoother.relax(jacobian.space.read_pressure(r))
        return np.array(errors), np.array(residuals)

    return run


WAVES = pytest.mark.parametrize("along, across", [(1, 0), (0, 1), (1, 1)], ids=["x", "y", "both"])


def oscillation(film, along, across):
    """An error that changes sign from node to node in the chosen directions, on the film."""
    mesh = film.problem.grid.mesh
    i, j = np.arange(mesh.nx)[None, :], np.arange(mesh.ny)[:, None]
    wave = (-1.0) ** (along * i + across * j)
    return np.where(film.outcome.state.status == LUBRICATED, wave, 0.0)


@WAVES
def test_residuals_of_oscillating_errors_decay(film, relax, along, across):
    _, residuals = relax(oscillation(film, along, across), 4)
    assert np.all(residuals[1:] < residuals[:-1])
    assert residuals[4] < 0.2 * residuals[0]


@WAVES
def test_oscillating_errors_under_high_pressure_decay(film, relax, along, across):
    """Where the relaxation is distributive the kernel rules, and the error itself must fall."""
    grid = film.problem.grid
    bell = np.exp(-(grid.X**2 + grid.Y**2) / 0.35**2)
    errors, _ = relax(bell * oscillation(film, along, across), 4)
    assert np.all(errors[1:] < errors[:-1])
    assert errors[4] < 0.1 * errors[0]


def test_relaxation_alone_does_not_diverge(film, relax):
    """A smooth error under high pressure, which a band of the kernel itself would overshoot."""
    grid = film.problem.grid
    errors, _ = relax(np.exp(-(grid.X**2 + grid.Y**2) / 0.35**2), 20)
    assert np.all(errors < 1.5 * errors[0])


@pytest.mark.parametrize("rigid", [False, True], ids=["elastic", "rigid"])
def test_given_pressures_get_no_correction(make_problem, rough_state, make_jacobian, make_smoother, rigid):
    problem = make_problem(nodes=NODES)
    state = rough_state(problem, contact=True)
    rows = rows_of(state.status, rigid)
    smoother = make_smoother(make_jacobian(problem, state, rigid), rows)
    assert isinstance(smoother, RigidLineSmoother if rigid else CrossedLineSmoother)
    correction = smoother.relax(np.ones(problem.grid.shape))
    given = (state.status == BOUNDARY) | (state.status == CAVITATED)
    np.testing.assert_array_equal(correction[given], 0.0)
    assert np.all(np.isfinite(correction)) and np.any(correction[~given] != 0.0)


def test_a_single_line_is_not_crossed(line_film, make_jacobian):
    solution = line_film(65)
    assert smoother_of(make_jacobian(solution.problem, solution.outcome.state)) is LineSmoother


def test_contact_whose_fluid_is_solved_apart_is_not_crossed(rough_state, make_problem, make_jacobian):
    problem = make_problem(nodes=NODES)
    jacobian = make_jacobian(problem, rough_state(problem, contact=True))
    assert smoother_of(jacobian) is CrossedLineSmoother
    assert smoother_of(jacobian, apart=True) is LineSmoother


class TestLinesAlongBothAxes:
    """The crossed smoother, of a motion at an angle, against dense matrices, on a grid that a band spans.

    A band is cut at 4 nodes, and the ends of a line are 5 apart: they and what is beside them are given, so
    that nothing moves there.
    """

    NODES = 6

    @pytest.fixture
    def jacobian(self, make_problem, paper_contact, rough_state, make_jacobian):
        contact = paper_contact(radius_y=20e-3, angle=30.0)
        problem = make_problem(contact, Scheme("2B", motion=contact.motion), nodes=self.NODES)
        return make_jacobian(problem, rough_state(problem))

    @pytest.fixture
    def rows(self):
        """Nodes that are distributive in the middle but for one; the pressures about them are given."""
        rows = np.full((self.NODES, self.NODES), PRESSURE)
        rows[2:-2, 2:-2] = FLOW
        rows[2, 3], rows[3, 2] = GAP, PRESSURE
        return rows

    @pytest.fixture
    def smoother(self, jacobian, rows, make_smoother):
        return make_smoother(jacobian, rows, CrossedLineSmoother)

    def parts(self, jacobian, rows, make_vec):
        """Q, and the parts of J Q along the x-lines, along the y-lines and on the diagonal."""
        n, K = self.NODES, influence_coefficients(jacobian.grid.mesh, jacobian.contact.kernel)
        distributive = distributive_nodes(jacobian.linearisation.eps, rows, jacobian.grid.mesh.dX, K[0, 0])
        assert distributive.any()
        Q = np.eye(n * n).reshape(n, n, n, n)
        for j, i in np.argwhere(distributive):
            for line, node in ((j - 1, i), (j + 1, i), (j, i - 1), (j, i + 1)):
                Q[line, node, j, i] = -0.25
        JQ, out = np.empty_like(Q), make_vec(jacobian.space)
        for j, i in np.ndindex(n, n):
            jacobian.mat.mult(make_vec(jacobian.space, Q[:, :, j, i]), out)
            JQ[:, :, j, i] = jacobian.space.read(out)[0]
        same = np.eye(n, dtype=bool)
        of_line, of_column = same[:, None, :, None], same[None, :, None, :]
        X, Y, D = (np.where(kept, JQ, 0.0) for kept in (of_line, of_column, of_line & of_column))
        return (each.reshape(n * n, n * n) for each in (Q, X, Y, D))

    def test_first_along_x_and_then_along_y_and_the_next_time_the_other_way_round(
        self, smoother, jacobian, rows, make_vec
    ):
        Q, X, Y, D = self.parts(jacobian, rows, make_vec)
        r = np.random.default_rng(8).standard_normal((self.NODES, self.NODES))
        r[[0, -1]], r[:, [0, -1]] = 0.0, 0.0
        for first, then in ((X, Y), (Y, X), (X, Y)):
            correction = smoother.relax(r)
            w = np.linalg.solve(first @ np.linalg.solve(D, then), r.ravel())
            expected = np.where(rows == PRESSURE, 0.0, OMEGA * (Q @ w).reshape(r.shape))
            np.testing.assert_allclose(correction, expected, rtol=1e-9, atol=1e-11 * np.abs(expected).max())

    def test_new_rows_begin_along_x_again(self, smoother):
        """A factorisation must not depend on how many relaxations came before it."""
        corrections = []
        for _ in range(2):
            smoother.factor()
            corrections.append(smoother.relax(np.ones((self.NODES, self.NODES))).copy())
        np.testing.assert_array_equal(*corrections)
