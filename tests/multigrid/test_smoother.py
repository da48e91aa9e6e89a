"""The distributive line smoother as a preconditioner of its own."""

import numpy as np
import pytest
from mpi4py import MPI
from petsc4py import PETSc

from mgehl.discretization.bands import distributive_nodes
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.rows import FLOW, GAP, PRESSURE
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, CAVITATED, LUBRICATED
from mgehl.multigrid.smoother import CrossedLineSmoother
from mgehl.solver.problem import ContactProblem

NODES = 65


@pytest.fixture
def make_smoother():
    """Factory of functions r -> correction: one relaxation on the finest grid of a cycle."""
    made = []

    def make(multigrid):
        ksp = PETSc.KSP().create(MPI.COMM_SELF)
        made.append(ksp)
        ksp.setOptionsPrefix("test_")
        multigrid.configure(ksp, 1e-2)
        ksp.setUp()
        smoother = ksp.getPC().getMGSmoother(len(multigrid.jacobians) - 1)
        smoother.setUp()
        return smoother.getPC().apply

    yield make
    for ksp in made:
        ksp.destroy()


@pytest.fixture
def film(solve, paper_contact):
    """The solved full film at 1 m/s."""
    return solve(paper_contact(), NODES)


@pytest.fixture
def relax(film, make_multigrid, make_smoother, make_vec):
    """Function: norms of error and residual after 0, 1, 2 ... relaxations of J e = 0."""
    multigrid = make_multigrid(film.hierarchy, film.problem, film.outcome.state)
    smooth, mat = make_smoother(multigrid), multigrid.jacobian.mat

    def run(error, relaxations):
        e, r, correction = make_vec(multigrid.space, error), *(make_vec(multigrid.space) for _ in range(2))
        errors, residuals = [], []
        for _ in range(relaxations + 1):
            mat.mult(e, r)
            errors.append(e.norm())
            residuals.append(r.norm())
            smooth(r, correction)
            e.axpy(-1.0, correction)
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


def test_the_border_is_left_alone(film, make_multigrid, make_smoother, make_vec):
    multigrid = make_multigrid(film.hierarchy, film.problem, film.outcome.state)
    smooth, ones = make_smoother(multigrid), np.ones(film.problem.grid.shape)
    corrections = []
    for border in (0.0, 100.0):
        corrected = make_vec(multigrid.space)
        smooth(make_vec(multigrid.space, ones, border), corrected)
        correction, dH0 = multigrid.space.read(corrected)
        assert dH0 == 0.0
        corrections.append(correction.copy())
    np.testing.assert_array_equal(*corrections)
    assert np.any(corrections[0] != 0.0)


@pytest.mark.parametrize("rigid", [False, True], ids=["elastic", "rigid"])
def test_given_pressures_get_no_correction(
    make_hierarchy, paper_contact, rough_state, make_multigrid, make_smoother, make_vec, rigid
):
    hierarchy = make_hierarchy(paper_contact(), NODES)
    problem = ContactProblem(hierarchy.grids[-1], hierarchy.deflections[-1], paper_contact(), Scheme())
    state = rough_state(problem, contact=True)
    multigrid = make_multigrid(hierarchy, problem, state, rigid)
    corrected = make_vec(multigrid.space)
    make_smoother(multigrid)(make_vec(multigrid.space, np.ones(problem.grid.shape)), corrected)
    correction, _ = multigrid.space.read(corrected)
    given = (state.status == BOUNDARY) | (state.status == CAVITATED)
    np.testing.assert_array_equal(correction[given], 0.0)
    assert np.all(np.isfinite(correction)) and np.any(correction[~given] != 0.0)


class TestLinesAlongBothAxes:
    """The smoother of a motion at an angle against dense matrices, on a grid that a band spans.

    A band is cut at 5 nodes, and the ends of a line are 6 apart: they and what is beside them are given, so
    that nothing moves there.
    """

    NODES, OMEGA = 7, 0.8

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
    def smoother(self, jacobian, rows):
        made = CrossedLineSmoother(jacobian, self.OMEGA)
        made.partition(rows)
        made.setUp(None)
        yield made
        made.free()

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
        corrected = make_vec(jacobian.space)
        for first, then in ((X, Y), (Y, X), (X, Y)):
            smoother.apply(None, make_vec(jacobian.space, r), corrected)
            w = np.linalg.solve(first @ np.linalg.solve(D, then), r.ravel())
            damped = 0.5 * (1.0 + self.OMEGA) * (Q @ w)
            expected = np.where(rows == PRESSURE, 0.0, damped.reshape(r.shape))
            correction, border = jacobian.space.read(corrected)
            np.testing.assert_allclose(correction, expected, rtol=1e-9, atol=1e-11 * np.abs(expected).max())
            assert border == 0.0

    def test_new_rows_begin_along_x_again(self, smoother, jacobian, rows, make_vec):
        """A factorisation must not depend on how many relaxations came before it."""
        x, corrections = make_vec(jacobian.space, np.ones((self.NODES, self.NODES))), []
        for _ in range(2):
            smoother.setUp(None)
            corrected = make_vec(jacobian.space)
            smoother.apply(None, x, corrected)
            corrections.append(jacobian.space.read(corrected)[0].copy())
        np.testing.assert_array_equal(*corrections)
