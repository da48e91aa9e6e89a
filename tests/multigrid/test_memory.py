"""What is remembered of linear systems solved before, on a rough ball of 65 nodes."""

import numpy as np
import pytest
from mpi4py import MPI
from petsc4py import PETSc

from mgehl.discretization.contact_law import BoundaryFilm
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import LUBRICATED
from mgehl.model.surface import Surface
from mgehl.multigrid import memory
from mgehl.multigrid.cycle import MultigridSolver
from mgehl.multigrid.memory import Memory, softest
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


def test_rough_surfaces_are_solved_with_a_memory(rough):
    _, _, ksp, *_ = rough
    assert isinstance(ksp.getPC().getPythonContext(), Memory)


def test_the_same_system_is_not_solved_twice(rough, solved):
    """All corrections of the first solve are remembered, so their combination is the answer."""
    problem, solver, _, evaluation, state = rough
    first = solved()
    solver.linearise(evaluation, problem.rows(state.status), 10.0)
    assert first > 5 and solved() <= 2


def test_a_system_like_the_last_one_takes_fewer_iterations(rough, solved):
    problem, solver, _, evaluation, state = rough
    first = solved()
    solver.linearise(evaluation, problem.rows(state.status), 11.0)
    assert solved() <= 0.7 * first


def test_remembering_makes_no_convolution(rough, solved):
    """One product an iteration, and on coarse grids what the cycle makes anyway."""
    problem, solver, ksp, evaluation, state = rough
    solved()
    solver.linearise(evaluation, problem.rows(state.status), 11.0)
    before = problem.deflection.count
    ksp.setUp()
    assert problem.deflection.count == before
    iterations = solved()
    assert problem.deflection.count - before <= iterations + 1


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


def test_no_more_is_remembered_than_there_is_room_for(rough, monkeypatch):
    problem, solver, *_ = rough
    monkeypatch.setattr(memory, "NODES", 3 * problem.grid.mesh.nodes)
    few, b = Memory(solver.jacobian, Itself()), solver.space.create_vec()
    y, P = b.duplicate(), np.zeros(problem.grid.shape)
    for number in range(5):
        solver.space.write(b, P + number, 0.0)
        few.apply(None, b, y)
        solver.jacobian.mat.mult(y, b)
    assert [value[0] for value, _, _ in few._seen] == [2.0, 3.0, 4.0]
    b.destroy()
    y.destroy()


class Itself:
    """A cycle that does nothing."""

    def apply(self, _pc, x, y):
        x.copy(y)


class TestSoftest:
    """Images and causes are given by their products; the identity answers them by themselves."""

    def test_images_are_orthonormal(self):
        images = np.random.default_rng(1).standard_normal((4, 9))
        gram = images @ images.T
        weights = softest(gram, gram, 10)
        assert weights.T @ gram @ weights == pytest.approx(np.eye(4), abs=1e-12)

    def test_what_depends_on_others_is_left_out(self):
        images = np.array([[1.0, 2.0, 0.0], [2.0, 4.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 3.0]])
        gram = images @ images.T
        assert softest(gram, gram, 10).shape == (4, 2)

    @pytest.mark.parametrize("most", [1, 2, 3])
    def test_the_smallest_images_beside_their_causes_are_taken(self, most):
        """Images 10, 1, .1 and 4 times causes that are orthonormal."""
        times = np.array([10.0, 1.0, 0.1, 4.0])
        weights = softest(np.diag(times**2), np.diag(times), most)
        assert weights.shape == (4, most)
        taken = np.flatnonzero(np.abs(weights).max(axis=1) > 1e-12)
        assert sorted(taken) == sorted(np.argsort(times)[:most])

    def test_a_pair_of_complex_modes_is_taken_whole(self):
        """Causes turned by a right angle about their images: two modes that only exist together."""
        turned = np.array([[0.0, 5.0, 0.0], [-5.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
        weights = softest(np.eye(3), turned, 2)
        assert np.abs(weights[2]).max() < 1e-12
