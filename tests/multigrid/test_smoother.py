"""The distributive line smoother as a preconditioner of its own."""

import numpy as np
import pytest
from mpi4py import MPI
from petsc4py import PETSc

from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, CAVITATED, LUBRICATED
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
