"""The V-cycle as a solver and as the preconditioner of flexible GMRES."""

import numpy as np
import pytest
from mpi4py import MPI
from petsc4py import PETSc

from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED

SIZES = (65, 129)


@pytest.fixture
def make_ksp():
    """Factory of KSPs that use a `MultigridSolver`; destroyed after the test."""
    made = []

    def make(multigrid, rtol=1e-2):
        ksp = PETSc.KSP().create(MPI.COMM_SELF)
        made.append(ksp)
        ksp.setOptionsPrefix("test_")
        multigrid.configure(ksp, rtol)
        return ksp

    yield make
    for ksp in made:
        ksp.destroy()


@pytest.fixture
def film(solve, paper_contact, make_multigrid):
    """Function: the film problem at 1 m/s linearised about its solution, on n nodes."""

    def make(nodes, **settings):
        solution = solve(paper_contact(), nodes)
        state = solution.outcome.state
        return make_multigrid(solution.hierarchy, solution.problem, state, **settings), state

    return make


def right_hand_side(kind, multigrid, state, where=None):
    """Residuals of the film nodes: white noise, or one long bulge; and a load error."""
    where = state.status == LUBRICATED if where is None else where
    grid = multigrid.space.grid
    if kind == "noise":
        r = np.random.default_rng(11).standard_normal(grid.shape)
    else:
        r = np.exp(-(grid.X**2) - grid.Y**2)
    return np.where(where, r, 0.0), 0.3


def richardson(multigrid, ksp, make_vec, b, cycles):
    """Residual norms of x += (V-cycle) (b - J x) from x = 0."""
    x, r, correction = (make_vec(multigrid.space) for _ in range(3))
    mat = multigrid.jacobians[-1].mat
    norms = []
    for _ in range(cycles):
        mat.mult(x, r)
        r.aypx(-1.0, b)
        norms.append(r.norm())
        # One V-cycle: the preconditioner alone.
        ksp.getPC().apply(r, correction)
        x.axpy(1.0, correction)
    return np.array(norms)


@pytest.mark.parametrize("kind", ["noise", "bulge"])
@pytest.mark.parametrize("nodes", SIZES)
def test_stationary_convergence(film, make_ksp, make_vec, nodes, kind):
    """V(2,2) by itself takes at least half of the residual away with every cycle."""
    multigrid, state = film(nodes, sweeps=2)
    ksp = make_ksp(multigrid)
    ksp.setUp()
    b = make_vec(multigrid.space, *right_hand_side(kind, multigrid, state))
    norms = richardson(multigrid, ksp, make_vec, b, 13)
    factor = (norms[-1] / norms[4]) ** (1 / 8)
    assert factor < 0.5


@pytest.mark.parametrize("kind", ["noise", "bulge"])
@pytest.mark.parametrize("nodes", SIZES)
def test_gmres_iterations(film, make_ksp, make_vec, nodes, kind):
    multigrid, state = film(nodes)
    ksp = make_ksp(multigrid)
    b, x, r = (make_vec(multigrid.space) for _ in range(3))
    multigrid.space.write(b, *right_hand_side(kind, multigrid, state))
    ksp.solve(b, x)
    assert ksp.getConvergedReason() > 0
    assert ksp.getIterationNumber() <= 6
    # GMRES says so; the true residual must too.
    multigrid.jacobians[-1].mat.mult(x, r)
    r.aypx(-1.0, b)
    assert r.norm() <= 1.01e-2 * b.norm()


@pytest.mark.parametrize("kind", ["noise", "bulge"])
@pytest.mark.parametrize("nodes", SIZES)
def test_gmres_iterations_in_contact(solve, paper_contact, make_multigrid, make_ksp, make_vec, nodes, kind):
    """Full contact at 0.005 mm/s; the fluid around it is solved apart and given here."""
    solution = solve(paper_contact(5e-6), nodes, start="contact")
    state = solution.outcome.state.copy()
    contact = state.status == CONTACT
    assert contact.sum() > 1000
    state.status[state.status == LUBRICATED] = BOUNDARY
    multigrid = make_multigrid(solution.hierarchy, solution.problem, state)
    ksp = make_ksp(multigrid)
    r, load = right_hand_side(kind, multigrid, state, contact)
    b, x = make_vec(multigrid.space, r, load), make_vec(multigrid.space)
    ksp.solve(b, x)
    assert ksp.getConvergedReason() > 0
    assert ksp.getIterationNumber() <= 6


def test_rigid_gap_makes_no_convolution(solve, make_multigrid, paper_contact, make_ksp, make_vec):
    solution = solve(paper_contact(), 65)
    state = solution.outcome.state
    multigrid = make_multigrid(solution.hierarchy, solution.problem, state, rigid=True)
    ksp = make_ksp(multigrid)
    before = solution.hierarchy.convolutions
    b, x = make_vec(multigrid.space), make_vec(multigrid.space)
    multigrid.space.write(b, *right_hand_side("bulge", multigrid, state))
    ksp.solve(b, x)
    assert solution.hierarchy.convolutions == before
    assert ksp.getConvergedReason() > 0


def test_given_pressures_stay(film, make_ksp, make_vec):
    multigrid, state = film(65)
    ksp = make_ksp(multigrid)
    b, x = make_vec(multigrid.space, *right_hand_side("noise", multigrid, state)), make_vec(multigrid.space)
    ksp.solve(b, x)
    correction, _ = multigrid.space.read(x)
    given = (state.status == CAVITATED) | multigrid.space.grid.boundary()
    assert given.sum() > 100
    np.testing.assert_array_equal(correction[given], 0.0)


def test_one_grid_is_solved_directly(solve, paper_contact, make_multigrid, make_ksp, make_vec):
    solution = solve(paper_contact(3.0), 33)
    state = solution.outcome.state
    multigrid = make_multigrid(solution.hierarchy, solution.problem, state)
    ksp = make_ksp(multigrid, rtol=1e-9)
    b, x = make_vec(multigrid.space, *right_hand_side("noise", multigrid, state)), make_vec(multigrid.space)
    ksp.solve(b, x)
    assert ksp.getConvergedReason() > 0
    assert ksp.getIterationNumber() == 1


def test_petsc_options_change_the_solver(film, make_ksp, petsc_options):
    multigrid, _ = film(65)
    petsc_options["test_ksp_max_it"] = 3
    petsc_options["test_ksp_type"] = "gmres"
    ksp = make_ksp(multigrid)
    assert ksp.getTolerances()[3] == 3
    assert ksp.getType() == "gmres"
    assert ksp.getPC().getType() == "mg"
