import numpy as np
import pytest
from dry_surfaces import surface
from scipy.optimize import nnls

from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.status import CONTACT
from mgehl.model.coating import Coating
from mgehl.model.line import LineContact
from mgehl.solver.dry import solve_dry
from mgehl.studies.dry import REFERENCE

TOLERANCE = 1e-8


def settle(problem, P=None, max_steps=60, told=lambda step: None):
    """The `Outcome` of a problem from the smooth contact's pressure, and its convolutions."""
    grid, before = problem.grid, problem.deflection.count
    P = problem.contact.guessed_pressure(grid.X, grid.Y) if P is None else P
    outcome = solve_dry(problem, P, TOLERANCE, max_steps, told)
    return outcome, problem.deflection.count - before


def assert_complementary(problem, state, tolerance=1e-10):
    """P >= 0, gap >= 0, one of them zero; the load is carried; the status says which."""
    gap, pressed = problem.gap(state.P, state.H0), state.P > 0.0
    assert problem.load_deficit(state.P) == pytest.approx(0.0, abs=1e-13)
    assert (state.P >= 0.0).all() and not state.P[problem.boundary].any()
    assert np.abs(gap[pressed]).max() < tolerance and gap.min() > -tolerance
    np.testing.assert_allclose(state.H, gap, rtol=0.0, atol=1e-11)
    np.testing.assert_array_equal(state.status == CONTACT, pressed)


class TestAnswers:
    def test_the_smooth_ball_is_that_of_hertz(self, make_problem):
        problem = make_problem(nodes=65)
        outcome, convolutions = settle(problem)
        state = outcome.state
        assert outcome.converged and convolutions < 20
        assert_complementary(problem, state)
        hertz = problem.contact.guessed_pressure(problem.grid.X, problem.grid.Y)
        assert state.P.max() == pytest.approx(1.0, abs=2e-4)
        assert -state.H0 == pytest.approx(problem.contact.approach, rel=1e-4)
        assert np.abs(state.P - hertz)[hertz > 0.5].max() < 2e-3

    def test_the_cylinder_is_that_of_hertz(self, paper_contact, make_problem):
        line_contact = LineContact(1.86e6, 12.7e-3, 219.78e9, 1.0, paper_contact().lubricant)
        problem = make_problem(line_contact, nodes=1025, x=(-4.0, 2.0), y=(0.0, 0.0), ny=1)
        outcome, convolutions = settle(problem)
        assert outcome.converged and convolutions < 15
        assert_complementary(problem, outcome.state)
        assert -outcome.state.H0 == pytest.approx(line_contact.approach, rel=1e-5)
        assert outcome.state.P.max() == pytest.approx(1.0, abs=1e-5)

    def test_any_surface_is_the_least_energy(self, make_problem):
        """Beside another method: least squares without negative numbers, of the dense matrix."""
        problem = make_problem(nodes=17)
        random = np.random.default_rng(3)
        problem.undeformed = problem.undeformed + 0.2 * random.random(problem.grid.shape)
        outcome, _ = settle(problem)
        state, inner = outcome.state, ~problem.boundary
        K = influence_coefficients(problem.grid.mesh, problem.contact.kernel)
        j, i = np.nonzero(inner)
        dense = K[np.abs(np.subtract.outer(j, j)), np.abs(np.subtract.outer(i, i))]
        # With the approach given: P K P/2 + P (gap - approach), which is |R P - c|^2/2 of K = R' R.
        root = np.linalg.cholesky(dense).T
        target = np.linalg.solve(root.T, -(problem.undeformed[inner] + state.H0))
        expected, _ = nnls(root, target, maxiter=5000)
        assert 5 < (expected > 0.0).sum() < 100 < inner.sum()
        np.testing.assert_allclose(state.P[inner], expected, rtol=0.0, atol=1e-8)

    def test_it_does_not_hang_on_the_guess(self, make_problem, paper_contact):
        problem = make_problem(paper_contact(surface=surface("rough 500 nm")), nodes=65)
        grid = problem.grid
        bad = np.where((grid.X + 0.4) ** 2 + grid.Y**2 < 0.1, 1.0, 0.0)
        states = [settle(problem, P)[0].state for P in (None, bad)]
        np.testing.assert_allclose(states[0].P, states[1].P, rtol=0.0, atol=1e-8)

    @pytest.mark.parametrize("flat", [True, False])
    def test_a_single_node_carries_the_load(self, make_problem, flat):
        problem = make_problem(nodes=17)
        peak = np.zeros(problem.grid.shape)
        peak[8, 7] = 1e3
        problem.undeformed = (0.0 if flat else 1.0) * problem.undeformed - peak
        outcome, _ = settle(problem)
        assert outcome.converged and outcome.state.P[8, 7] > 0.0
        assert np.count_nonzero(outcome.state.P) == 1


@pytest.mark.parametrize("name, nodes", REFERENCE)
def test_a_public_code_s_numbers(make_problem, paper_contact, name, nodes):
    """Nodes in contact, p_max in GPa and approach in um; and the work: at most 60 convolutions."""
    problem, known = make_problem(paper_contact(surface=surface(name)), nodes=nodes), REFERENCE[name, nodes]
    outcome, convolutions = settle(problem)
    state, contact = outcome.state, problem.contact
    assert outcome.converged
    assert_complementary(problem, state)
    assert np.count_nonzero(state.P) == known.contact_nodes
    assert 1e-9 * contact.pressure_scale * state.P.max() == pytest.approx(known.max_pressure, rel=1e-6)
    assert -1e6 * contact.film_scale * state.H0 == pytest.approx(known.approach, abs=1e-6)
    assert convolutions <= 60


def coating(contact, modulus, thickness):
    """On one of two steel bodies; `thickness` in units of a."""
    return Coating(thickness * contact.hertz.a, modulus, 0.3, None, 0.3, contact.reduced_modulus)


@pytest.fixture
def problem(paper_contact, make_problem):
    def make(modulus, thickness):
        bare = paper_contact()
        contact = paper_contact(deformation=coating(bare, modulus, thickness))
        return make_problem(contact, nodes=65, x=(-2.1, 2.1), y=(-2.1, 2.1))

    return make


@pytest.mark.parametrize("modulus", [4e9, 50e9, 800e9])
def test_a_coated_ball_settles(problem, modulus):
    problem = problem(modulus, 0.3)
    outcome, convolutions = settle(problem)
    assert outcome.converged and convolutions < 25
    assert_complementary(problem, outcome.state)
