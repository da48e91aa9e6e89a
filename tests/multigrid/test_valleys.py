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
from mgehl.multigrid.cycle import MultigridSolver
from mgehl.solver.problem import ContactProblem

HARD, MIDDLING, EASY = 1e-4, 1e-3, 0.1
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


class TestLinesAlongYInValleys:
    """The finest grid's smoother by lines, on the system of waves."""

    @pytest.fixture
    def linearised(self, system):
        """Function: the `RoughLineSmoother` at a speed, and a residual."""

        def make(speed):
            made = system(speed)
            made.linearise()
            smoother = valleys.RoughLineSmoother(made.multigrid.jacobian, 0.8)
            smoother.partition(made.problem.rows(made.state.status))
            smoother.factor()
            return smoother, made.multigrid.space.read_pressure(made.b)

        return make

    def test_where_the_pressure_drives_nothing_lines_along_x_are_all(self, linearised, monkeypatch):
        monkeypatch.setattr(valleys, "DRIVEN", 1e30)
        smoother, r = linearised(EASY)
        along_x = smoother.relax(r).copy()
        smoother._bands.solve(r, smoother._w)
        np.testing.assert_array_equal(along_x, smoother._distributed(0.8, along_y=False))

    def test_lines_along_y_are_solved_for_what_is_left_at_driven_nodes(self, linearised):
        smoother, r = linearised(EASY)
        jacobian, driven = smoother._jacobian, smoother._driven
        assert 0 < np.count_nonzero(driven) < np.count_nonzero(~jacobian.given)
        whole = smoother.relax(r.copy()).copy()
        smoother._bands.solve(r, smoother._w)
        along_x = smoother._distributed(0.8, along_y=False).copy()
        K, padded = smoother._near, np.pad(along_x, 1)
        lines, nx = along_x.shape
        near = sum(
            K[abs(line - 1), abs(node - 1)] * padded[line : line + lines, node : node + nx]
            for line, node in np.ndindex(3, 3)
        )
        rest = np.where(driven, r - jacobian.product(along_x, near, 0.0), 0.0)
        smoother._y_bands.solve(rest, smoother._w)
        expected = along_x + smoother._distributed(0.8, along_x=False)
        np.testing.assert_allclose(whole, expected, rtol=1e-9, atol=1e-12 * np.abs(expected).max())
        assert np.abs(whole - along_x).max() > 0.0

    def test_given_pressures_get_no_correction(self, linearised):
        smoother, r = linearised(EASY)
        correction = smoother.relax(np.ones_like(r))
        assert not correction[smoother._jacobian.given].any()


class TestAtOnceAroundTheContact:
    """The finest grid's smoother after a hard system: a direct solve in a zone, lines beyond."""

    @pytest.fixture
    def smoother(self, system, monkeypatch):
        """In a zone that is narrower than the contact."""
        monkeypatch.setattr(valleys, "ZONE", 0.5)
        made = system()
        made.linearise()
        smoother = valleys.ValleySmoother(made.multigrid.jacobian, 0.8)
        smoother.way = valleys.AT_ONCE
        smoother.partition(made.problem.rows(made.state.status))
        smoother.factor()
        assert 100 < np.count_nonzero(smoother._zone) < 0.1 * smoother._zone.size
        yield smoother
        smoother.free()

    @pytest.fixture
    def r(self, smoother):
        return np.random.default_rng(3).standard_normal(smoother._zone.shape)

    def test_the_zone_takes_what_lines_beyond_it_leave(self, smoother, r):
        zone, w = smoother._zone, np.zeros(r.shape)
        beyond = valleys.RoughLineSmoother.relax(smoother, np.where(zone, 0.0, r)).copy()
        smoother._nearby.solve(r - smoother._near_product(beyond), w)
        found = smoother.relax(r.copy())
        smoother._w[:] = w
        expected = beyond + smoother._distributed(1.0)
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-9 * np.abs(expected).max())

    def test_far_beyond_it_lines_are_all(self, smoother, r):
        """Q hands something over to the nodes beside the zone, and to none beyond these."""
        by_lines = valleys.RoughLineSmoother.relax(smoother, np.where(smoother._zone, 0.0, r)).copy()
        changed = smoother.relax(r.copy()) != by_lines
        near = np.pad(smoother._zone, 1)
        reached = near[1:-1, 1:-1] | near[:-2, 1:-1] | near[2:, 1:-1] | near[1:-1, :-2] | near[1:-1, 2:]
        assert changed[smoother._zone].any() and not changed[~reached].any()


@pytest.fixture
def by_lines(system, monkeypatch):
    """Iterations of the hard system where lines alone relax it."""
    with monkeypatch.context() as patch:
        patch.setattr(valleys, "PATIENCE", 1000)
        return system().iterations()


def test_at_once_it_takes_a_third_of_the_iterations(system, by_lines):
    hard = system()
    hard.multigrid.way = valleys.AT_ONCE
    assert hard.iterations() < 0.4 * by_lines and by_lines > 70


def test_a_hard_system_is_finished_at_once_and_the_next_one_begins_so(system, by_lines):
    hard = system()
    first, second = hard.iterations(), hard.iterations()
    assert hard.multigrid.way == valleys.AT_ONCE
    assert valleys.PATIENCE < first < by_lines
    assert second < first - 0.5 * valleys.PATIENCE


def test_what_is_no_better_at_once_is_left_to_the_lines_again(system, monkeypatch):
    """In the middle of that system, and for good."""
    monkeypatch.setattr(valleys, "PATIENCE", 10)
    monkeypatch.setattr(valleys, "MOST_AT_ONCE", 3)
    hard = system(MIDDLING)
    assert hard.iterations() > valleys.PATIENCE + valleys.MOST_AT_ONCE
    assert hard.multigrid.way == valleys.BY_LINES_AGAIN
    again = hard.iterations()
    assert hard.multigrid.way == valleys.BY_LINES_AGAIN
    monkeypatch.setattr(valleys, "PATIENCE", 1000)
    assert again == system(MIDDLING).iterations()


def test_an_easy_one_is_left_to_the_lines(system):
    easy = system(EASY)
    assert easy.iterations() < valleys.PATIENCE
    assert easy.multigrid.way == valleys.BY_LINES


def test_a_large_grid_is_left_to_the_lines(system, by_lines, monkeypatch):
    monkeypatch.setattr(valleys, "LARGEST", 1000)
    large = system()
    assert large.iterations() == by_lines
    assert large.multigrid.way == valleys.BY_LINES


def test_smooth_bodies_have_no_valleys(make_hierarchy, paper_contact):
    contact = paper_contact(HARD)
    hierarchy = make_hierarchy(contact, 65)
    multigrid = MultigridSolver(hierarchy, len(hierarchy.grids) - 1, contact, Scheme())
    assert multigrid.way == ""
    multigrid.free()
