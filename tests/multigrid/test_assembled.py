import numpy as np
import pytest
from petsc4py import PETSc

from mgehl.discretization.residual import residual
from mgehl.discretization.rows import PRESSURE, rows_of
from mgehl.discretization.status import CAVITATED, CONTACT
from mgehl.multigrid.assembled import AssembledSolver
from mgehl.solver.problem import State


def rigid_rows(state):
    return np.where(state.status == CONTACT, PRESSURE, rows_of(state.status))


@pytest.fixture
def assembled(make_problem, rough_state):
    """A solver linearised about a state with a contact, the KSP it made, problem and state."""
    problem = make_problem(nodes=33)
    state = rough_state(problem, contact=True)
    solver = AssembledSolver(problem.grid)
    ksp = PETSc.KSP().create(problem.grid.comm)
    solver.configure(ksp, 1e-10)
    solver.linearise(problem.evaluate(state), rigid_rows(state))
    yield solver, ksp, problem, state
    ksp.destroy()
    solver.free()


def test_matrix_is_the_derivative_of_the_residual_in_the_same_gap(assembled, make_vec):
    """By central differences; a cavity's pressure is given, the border's row is that of the identity."""
    solver, ksp, problem, state = assembled
    rows, h = rigid_rows(state), 1e-6
    dP = np.where(state.status == CAVITATED, 0.0, np.random.default_rng(2).random(problem.grid.shape))
    x, y = make_vec(solver.space, dP, 0.7), make_vec(solver.space)
    ksp.getOperators()[0].mult(x, y)
    found, border = solver.space.read(y)
    moved = (State(state.P + s * dP, 0.0, state.H, state.status) for s in (h, -h))
    ahead, behind = (residual(problem.evaluate(each), rows) for each in moved)
    expected = (ahead - behind) / (2.0 * h)
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-7 * np.abs(expected).max())
    assert border == 0.7
