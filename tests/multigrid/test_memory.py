"""What is remembered of linear systems solved before, on a rough ball of 65 nodes."""

import numpy as np
import pytest
from mpi4py import MPI
from petsc4py import PETSc

from mgehl.discretization.contact_law import BoundaryFilm
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import LUBRICATED
from mgehl.model.surface import Surface
from mgehl.multigrid.cycle import MultigridSolver
from mgehl.solver.problem import ContactProblem


class Waves(Surface):
    """Heights of 400 nm in waves of half the Hertz radius."""

    def __init__(self, a):
        self.a = a

    def height(self, x, y):
        return -4e-7 * np.cos(4.0 * np.pi * x / self.a) * np.cos(4.0 * np.pi * y / self.a)


@pytest.fixture
def rough(paper_contact, make_hierarchy):
    """A full film on a wavy ball: its problem, solver and KSP, linearised at a first guess."""
    contact = paper_contact(0.1, surface=Waves(4.1e-4))
    hierarchy = make_hierarchy(contact, 65)
    scheme = Scheme("1B", "linear-gap", contact_law=BoundaryFilm(1e-5))
    problem = ContactProblem(hierarchy.grids[-1], hierarchy.deflections[-1], contact, scheme)
    solver = MultigridSolver(hierarchy, len(hierarchy.grids) - 1, contact, scheme)
    ksp = PETSc.KSP().create(MPI.COMM_SELF)
    solver.configure(ksp, 1e-3)
    P = contact.guessed_pressure(problem.grid.X, problem.grid.Y)
    state = problem.state(P, problem.touching(P) + 0.1, np.full(problem.grid.shape, LUBRICATED))
    evaluation = problem.evaluate(state)
    solver.linearise(evaluation, problem.rows(state.status), 10.0)
    yield problem, solver, ksp, evaluation, state
    ksp.destroy()
    solver.free()


@pytest.fixture
def solved(rough):
    """Solve for a right-hand side; return the function that does, and its vectors."""
    problem, solver, ksp, _, state = rough
    b, x = (solver.space.create_vec() for _ in range(2))
    noise = np.random.default_rng(3).standard_normal(problem.grid.shape)
    solver.space.write(b, np.where(state.status == LUBRICATED, noise, 0.0), 0.1)

    def run():
        ksp.solve(b, x)
        return ksp.getIterationNumber()

    yield run
    b.destroy()
    x.destroy()


def test_the_same_system_is_not_solved_twice(rough, solved):
    """All corrections of the first solve are remembered, so their combination is the answer."""
    problem, solver, _, evaluation, state = rough
    first = solved()
    solver.linearise(evaluation, problem.rows(state.status), 10.0)
    assert first > 5 and solved() <= 2


def test_what_is_known_can_be_taken_away_and_given_back(rough, solved):
    """A solve from there takes the same iterations, to the same bits."""
    problem, solver, _, evaluation, state = rough
    assert solver.memory.known is None
    solved()
    known, answers = solver.memory.known, []
    for _ in range(2):
        solver.memory.known = known
        solver.linearise(evaluation, problem.rows(state.status), 11.0)
        answers.append((solved(), solver.memory.known))
    assert answers[0][0] == answers[1][0]
    for one, other in zip(*(vars(each).values() for _, each in answers), strict=True):
        np.testing.assert_array_equal(one, other)
