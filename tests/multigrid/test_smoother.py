import numpy as np
import pytest

from mgehl.discretization.rows import rows_of
from mgehl.discretization.status import BOUNDARY, CAVITATED, LUBRICATED
from mgehl.multigrid.crossed_lines import CrossedLineSmoother
from mgehl.multigrid.smoother import LineSmoother
from mgehl.multigrid.valleys import RoughLineSmoother

NODES = 65


@pytest.fixture
def film(solve, paper_contact):
    return solve(paper_contact(), NODES)


@pytest.fixture(params=[LineSmoother, CrossedLineSmoother, RoughLineSmoother])
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


def test_given_pressures_get_no_correction(make_problem, rough_state, make_jacobian, make_smoother):
    problem = make_problem(nodes=NODES)
    state = rough_state(problem, contact=True)
    smoother = make_smoother(make_jacobian(problem, state), rows_of(state.status), CrossedLineSmoother)
    correction = smoother.relax(np.ones(problem.grid.shape))
    given = (state.status == BOUNDARY) | (state.status == CAVITATED)
    np.testing.assert_array_equal(correction[given], 0.0)
    assert np.all(np.isfinite(correction)) and np.any(correction[~given] != 0.0)
