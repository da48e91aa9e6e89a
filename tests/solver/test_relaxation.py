"""The paper's single-loop relaxation: a sweep against the printed equations, runs against Newton."""

import numpy as np
import pytest

from mgehl.discretization.contact_law import InterfaceConditions
from mgehl.discretization.fluid import fluid_state
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, LUBRICATED
from mgehl.solver.nested import single_loop
from mgehl.solver.problem import State
from mgehl.solver.relaxation import RelaxationSettings, relax
from mgehl.solver.settings import SolverSettings


@pytest.fixture
def problem(make_problem):
    """9 x 9 nodes at 1 m/s; the film may be in tension, so that nothing is cut."""
    return make_problem(nodes=9, scheme=Scheme(cavitation=False))


def rough(problem):
    """All film: random low pressures in a random gap in which both kinds of flow matter."""
    rng = np.random.default_rng(3)
    P = np.where(problem.boundary, 0.0, 0.02 + 0.02 * rng.random(problem.grid.shape))
    H = 0.15 + 0.1 * rng.random(problem.grid.shape)
    status = np.where(problem.boundary, BOUNDARY, LUBRICATED).astype(np.int8)
    return State(P, 0.0, H, status)


def influence(problem):
    """D_k,0 of the paper."""
    return influence_coefficients(problem.grid.mesh, problem.contact.kernel, 0, 1)[0]


def printed(problem, state, node):
    """(alpha, beta, gamma, phi) of [Liu eqs. 37, 52] at a film node, y flows as in [Liu eq. 35].

    Terms of a face beside contact (H <= 0) are left out, whatever flows through it.
    """
    (j, i), mesh, D = node, problem.grid.mesh, influence(problem)
    P, H = state.P, state.H
    fluid = fluid_state(P, H, problem.contact, problem.scheme.contact_law)
    rho, west, east = fluid.rho, float(H[j, i - 1] > 0.0), float(H[j, i + 1] > 0.0)
    dX = mesh.dX
    eps_west = west * 0.5 * (fluid.eps[j, i - 1] + fluid.eps[j, i])
    eps_east = east * 0.5 * (fluid.eps[j, i] + fluid.eps[j, i + 1])
    out, into = east * rho[j, i], west * rho[j, i - 1]
    alpha = eps_west / dX**2 - (out * D[1] - into * D[0]) / dX
    beta = -(eps_west + eps_east) / dX**2 - out * D[0] / dX
    gamma = eps_east / dX**2 - (out * D[1] - into * D[2]) / dX
    phi = (
        out * (H[j, i] - D[1] * P[j, i - 1] - D[0] * P[j, i] - D[1] * P[j, i + 1])
        - into * (H[j, i - 1] - D[0] * P[j, i - 1] - D[2] * P[j, i + 1])
    ) / dX
    for other in (j - 1, j + 1) if not mesh.is_line else ():
        if H[other, i] > 0.0:
            across = 0.5 * (fluid.eps[j, i] + fluid.eps[other, i]) * (mesh.k_e / mesh.dY) ** 2
            beta -= across
            phi -= across * P[other, i]
    return alpha, beta, gamma, phi


class TestRuns:
    """65 nodes at 1 m/s."""

    def run(self, make_hierarchy, contact, cavitation=True, **settings):
        hierarchy, told = make_hierarchy(contact, 65), []
        limits = RelaxationSettings(**settings)
        law = InterfaceConditions(0.02e-9 / contact.film_scale)
        scheme = Scheme(cavitation=cavitation, contact_law=law)
        everything = SolverSettings(method="relaxation", scheme=scheme, relaxation=limits)
        problem, outcome = single_loop(hierarchy, contact, everything, lambda *each: told.append(each))
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
