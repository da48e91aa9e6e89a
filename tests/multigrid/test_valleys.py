"""Linear systems of films in valleys that peaks nearly shut in, on a wavy ball of 65 nodes."""

import numpy as np
import pytest
from mpi4py import MPI
from petsc4py import PETSc

from mgehl.discretization.contact_law import BoundaryFilm
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import LUBRICATED
from mgehl.model.surface.waviness import Waviness
from mgehl.multigrid import valleys
from mgehl.multigrid.cycle import CycleSettings, MultigridSolver
from mgehl.solver.problem import ContactProblem

OF_PEAKS = CycleSettings(rough=True, in_valleys=True)

HARD, EASY = 1e-4, 0.1
"""Speeds in m/s."""


WAVES = Waviness(8e-7, 2.05e-4, 2.05e-4, x=1.025e-4)
"""Heights of 800 nm in waves of half the Hertz radius, a valley in the middle."""


class System:
    """A linear system at a speed, with peaks 0.01 away from each other, and its solver."""

    def __init__(self, make_hierarchy, contact):
        hierarchy = make_hierarchy(contact, 65)
        scheme = Scheme("1B", "linear-gap", contact_law=BoundaryFilm(1e-6))
        self.problem = ContactProblem(hierarchy.grids[-1], hierarchy.deflections[-1], contact, scheme)
        self.multigrid = MultigridSolver(hierarchy, len(hierarchy.grids) - 1, contact, scheme, OF_PEAKS)
        self.ksp = PETSc.KSP().create(MPI.COMM_SELF)
        self.multigrid.configure(self.ksp, 1e-2)
        self.b, self.x = (self.multigrid.space.create_vec() for _ in range(2))
        noise = np.random.default_rng(1).standard_normal(self.problem.grid.shape)
        self.multigrid.space.write(self.b, np.where(self.problem.boundary, 0.0, noise), 0.3)

    def linearise(self):
        """About the dry pressure of smooth bodies with a film."""
        problem = self.problem
        P = problem.contact.guessed_pressure(problem.grid.X, problem.grid.Y)
        films = np.full(problem.grid.shape, LUBRICATED)
        self.state = problem.state(P, problem.touching(P) + 1e-2, films)
        self.multigrid.linearise(problem.evaluate(self.state), problem.rows(self.state.status))

    def iterations(self):
        """Of GMRES, without what it remembers of earlier systems."""
        self.multigrid.memory._seen = []
        self.linearise()
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


def test_an_easy_one_is_left_to_the_lines(system):
    easy = system(EASY)
    assert easy.iterations() < valleys.PATIENCE
    assert easy.multigrid.way == valleys.BY_LINES


def test_a_hard_system_is_finished_at_once_and_the_next_one_begins_so(system):
    hard = system()
    first, second = hard.iterations(), hard.iterations()
    assert hard.multigrid.way == valleys.AT_ONCE
    assert second < first - 0.5 * valleys.PATIENCE
