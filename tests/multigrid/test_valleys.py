"""Linear systems of films in valleys that peaks nearly shut in, on a wavy ball of 65 nodes."""

import numpy as np
import pytest
from mpi4py import MPI
from petsc4py import PETSc

from mgehl.discretization.contact_law import BoundaryFilm
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import LUBRICATED
from mgehl.model.surface.waviness import Waviness
from mgehl.multigrid import smoother
from mgehl.multigrid.cycle import MultigridSolver
from mgehl.solver.problem import ContactProblem

HARD, EASY = 1e-4, 1e-2
"""Speeds in m/s."""


WAVES = Waviness(8e-7, 2.05e-4, 2.05e-4, x=1.025e-4)
"""Heights of 800 nm in waves of half the Hertz radius, a valley in the middle."""


class System:
    """A linear system at a speed, with peaks 0.01 away from each other, and its solver."""

    def __init__(self, make_hierarchy, contact):
        hierarchy = make_hierarchy(contact, 65)
        scheme = Scheme("1B", "linear-gap", contact_law=BoundaryFilm(1e-6))
        self.problem = ContactProblem(hierarchy.grids[-1], hierarchy.deflections[-1], contact, scheme)
        self.multigrid = MultigridSolver(hierarchy, len(hierarchy.grids) - 1, contact, scheme)
        self.ksp = PETSc.KSP().create(MPI.COMM_SELF)
        self.multigrid.configure(self.ksp, 1e-3)
        self.b, self.x = (self.multigrid.space.create_vec() for _ in range(2))
        noise = np.random.default_rng(1).standard_normal(self.problem.grid.shape)
        self.multigrid.space.write(self.b, np.where(self.problem.boundary, 0.0, noise), 0.3)

    def iterations(self):
        """Of GMRES, without what it remembers of earlier systems."""
        problem = self.problem
        P = problem.contact.guessed_pressure(problem.grid.X, problem.grid.Y)
        state = problem.state(P, problem.touching(P) + 1e-2, np.full(problem.grid.shape, LUBRICATED))
        self.multigrid.memory._seen = []
        self.multigrid.linearise(problem.evaluate(state), problem.rows(state.status))
        self.ksp.solve(self.b, self.x)
        assert self.ksp.getConvergedReason() > 0
        return self.ksp.getIterationNumber()

    def free(self):
        for each in (self.ksp, self.b, self.x):
            each.destroy()
        self.multigrid.free()


@pytest.fixture
def system(make_hierarchy, paper_contact):
    """Function: the `System` of a speed."""
    made = []

    def make(speed=HARD):
        made.append(System(make_hierarchy, paper_contact(speed, surface=WAVES)))
        return made[-1]

    yield make
    for each in made:
        each.free()


@pytest.fixture
def by_lines(system, monkeypatch):
    """Iterations of the hard system where lines alone relax it."""
    with monkeypatch.context() as patch:
        patch.setattr(smoother, "PATIENCE", 1000)
        return system().iterations()


def test_at_once_it_takes_a_third_of_the_iterations(system, by_lines):
    hard = system()
    hard.multigrid.way = smoother.AT_ONCE
    assert hard.iterations() < 0.4 * by_lines and by_lines > 80


def test_a_hard_system_is_finished_at_once_and_the_next_one_begins_so(system, by_lines):
    hard = system()
    first, second = hard.iterations(), hard.iterations()
    assert hard.multigrid.at_once
    assert smoother.PATIENCE < first < by_lines
    assert second < first - 0.5 * smoother.PATIENCE


def test_what_is_no_better_at_once_is_left_to_the_lines_again(system, monkeypatch):
    """In the middle of that system, and for good."""
    monkeypatch.setattr(smoother, "PATIENCE", 10)
    monkeypatch.setattr(smoother, "MOST_AT_ONCE", 3)
    hard = system()
    hard.multigrid.configure(hard.ksp, 1e-2)
    assert hard.iterations() > smoother.PATIENCE + smoother.MOST_AT_ONCE
    assert hard.multigrid.way == smoother.BY_LINES_AGAIN and not hard.multigrid.at_once
    again = hard.iterations()
    assert hard.multigrid.way == smoother.BY_LINES_AGAIN
    monkeypatch.setattr(smoother, "PATIENCE", 1000)
    by_lines = system()
    by_lines.multigrid.configure(by_lines.ksp, 1e-2)
    assert again == by_lines.iterations()


def test_an_easy_one_is_left_to_the_lines(system):
    easy = system(EASY)
    easy.multigrid.configure(easy.ksp, 1e-2)
    assert easy.iterations() < smoother.PATIENCE
    assert not easy.multigrid.at_once


def test_a_large_grid_is_left_to_the_lines(system, by_lines, monkeypatch):
    monkeypatch.setattr(smoother, "LARGEST", 1000)
    large = system()
    assert large.iterations() == by_lines
    assert not large.multigrid.at_once


def test_smooth_bodies_have_no_valleys(make_hierarchy, paper_contact):
    contact = paper_contact(HARD)
    hierarchy = make_hierarchy(contact, 65)
    multigrid = MultigridSolver(hierarchy, len(hierarchy.grids) - 1, contact, Scheme())
    assert multigrid.way == "" and not multigrid.at_once
    multigrid.free()
