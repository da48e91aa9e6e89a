import numpy as np
import pytest
from petsc4py import PETSc

from mgehl.discretization.rows import rows_of
from mgehl.multigrid.assembled import AssembledSolver


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
