import numpy as np
import pytest
from mpi4py import MPI
from petsc4py import PETSc

from mgehl.discretization.mesh import Mesh
from mgehl.discretization.rows import rows_of
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.grid.grid import single_grid
from mgehl.model.wedge import WedgeBearing
from mgehl.multigrid.assembled import AssembledSolver
from mgehl.solver.wedge import WedgeProblem


@pytest.fixture
def assembled(make_problem, rough_state):
    """A solver linearised about a state with a contact, the KSP it made, problem and state."""
    problem = make_problem(nodes=33)
    state = rough_state(problem, contact=True)
    solver = AssembledSolver(problem.grid)
    ksp = PETSc.KSP().create(problem.grid.comm)
    solver.configure(ksp, 1e-10)
    solver.linearise(problem.evaluate(state), rows_of(state.status, rigid=True))
    yield solver, ksp, problem, state
    ksp.destroy()
    solver.free()


def test_matrix_is_the_rigid_jacobian(assembled, make_jacobian, make_vec):
    solver, ksp, problem, state = assembled
    jacobian = make_jacobian(problem, state, rigid=True)
    P = np.random.default_rng(2).random(problem.grid.shape)
    x, y, z = make_vec(solver.space, P, 0.7), make_vec(solver.space), make_vec(solver.space)
    jacobian.mat.mult(x, y)
    ksp.getOperators()[0].mult(x, z)
    z.axpy(-1.0, y)
    assert z.norm() <= 1e-12 * y.norm()


def test_few_iterations_solve_a_wedge(make_vec):
    """By hypre or by GAMG, whichever this PETSc has."""
    bearing = WedgeBearing(20e-3, 50e-3, 20e-3, 1e-3, 0.1, 1.0, blocked_exit=True)
    x_range, edges = bearing.placement(65)
    grid = single_grid(Mesh(65, 65, x_range, (-10.0, 10.0), edges=edges), MPI.COMM_SELF)
    problem = WedgeProblem(grid, bearing, Scheme(motion=(-1.0, 0.0)))
    state = problem.first_guess()
    solver, ksp = AssembledSolver(grid), PETSc.KSP().create(MPI.COMM_SELF)
    solver.configure(ksp, 1e-10)
    solver.linearise(problem.evaluate(state), problem.rows(state.status))
    film = state.status == LUBRICATED
    b, x = make_vec(solver.space, np.where(film, -1.0, 0.0)), make_vec(solver.space)
    ksp.solve(b, x)
    assert ksp.getConvergedReason() > 0 and ksp.getIterationNumber() <= 25
    P, border = solver.space.read(x)
    assert border == 0.0
    assert (P[film] > 0.0).all()
    np.testing.assert_allclose(P[state.status == CONTACT], 0.0, atol=1e-12 * P.max())
    ksp.destroy()
    solver.free()
    grid.destroy()
