import numpy as np
import pytest

from mgehl.discretization.contact_law import InterfaceConditions
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, LUBRICATED
from mgehl.solver.nested import single_loop
from mgehl.solver.problem import State
from mgehl.solver.relaxation import RelaxationSettings, relax
from mgehl.solver.settings import SolverSettings
from mgehl.solver.task import Task


def rough(problem):
    """All film: random low pressures in a random gap in which both kinds of flow matter."""
    rng = np.random.default_rng(3)
    P = np.where(problem.boundary, 0.0, 0.02 + 0.02 * rng.random(problem.grid.shape))
    H = 0.15 + 0.1 * rng.random(problem.grid.shape)
    status = np.where(problem.boundary, BOUNDARY, LUBRICATED).astype(np.int8)
    return State(P, 0.0, H, status)


class TestRuns:
    """65 nodes at 1 m/s."""

    def run(self, make_hierarchy, contact, cavitation=True, **settings):
        hierarchy, told = make_hierarchy(contact, 65), []
        limits = RelaxationSettings(**settings)
        law = InterfaceConditions(0.02e-9 / contact.film_scale)
        scheme = Scheme(cavitation=cavitation, contact_law=law)
        everything = SolverSettings(by_newton=False, scheme=scheme, relaxation=limits)
        task = Task(hierarchy, contact, everything, lambda *each: told.append(each))
        problem, outcome = single_loop(task)
        return hierarchy, problem, outcome, told

    def test_it_finds_the_film_that_newton_finds(self, make_hierarchy, solve, paper_contact):
        contact = paper_contact()
        hierarchy, problem, outcome, told = self.run(make_hierarchy, contact, omega=0.2, tolerance=1e-6)
        assert outcome.converged
        state, last = outcome.state, outcome.cycles[-1]
        true = problem.rms(problem.residual(problem.evaluate(state), state.status))
        assert true <= 1e-6 and abs(problem.load_deficit(state.P)) <= 1e-6
        newton = solve(contact, 65)
        nm = 1e9 * contact.film_scale
        for film, expected in zip(problem.films(state), newton.films, strict=True):
            assert film * nm == pytest.approx(expected, rel=1e-6)
        # One convolution a sweep, and one for the first guess.
        assert hierarchy.convolutions == last.step + 1
        assert [cycle.step for _, cycle in told] == list(range(0, last.step + 1, 100))
        # The error of [Liu eq. 45] is far below the residual: small steps, not a small error.
        assert last.e_p < 1e-3 * last.residual

    def test_sweeps_that_do_not_suffice_are_said(self, make_hierarchy, paper_contact):
        _, _, outcome, told = self.run(make_hierarchy, paper_contact(), max_sweeps=150)
        assert not outcome.converged
        assert "150 sweeps" in outcome.reason
        assert [cycle.step for _, cycle in told] == [0, 100, 150]

    def test_a_residual_without_a_way_back_ends_it(self, make_problem):
        problem = make_problem(nodes=9)
        state = rough(problem)
        state.H[4, 4] = 1e12
        with np.errstate(all="ignore"):
            outcome = relax(problem, state, RelaxationSettings(), lambda sweep: None)
        assert not outcome.converged
        assert outcome.reason.startswith("diverged") and outcome.reason.endswith("after 0 sweeps")
