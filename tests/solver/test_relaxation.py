"""The paper's single-loop relaxation: a sweep against the printed equations, runs against Newton."""

from dataclasses import replace

import numpy as np
import pytest

from mgehl.discretization.axes import own
from mgehl.discretization.contact_law import InterfaceConditions
from mgehl.discretization.fluid import fluid_state
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.model.line import LineContact
from mgehl.solver.nested import single_loop
from mgehl.solver.problem import State
from mgehl.solver.relaxation import RelaxationSettings, relax
from mgehl.solver.settings import SolverSettings

WHOLE_WAY = RelaxationSettings(omega=1.0, contact_share=1.0, max_sweeps=1, load_every=1000)
"""One sweep that takes every node all of the way to its new pressure."""

NODE = (4, 4)


def one_sweep(problem, state, settings=WHOLE_WAY):
    """The state after one sweep from `state`, which is not changed."""
    outcome = relax(problem, state.copy(), settings, lambda sweep: None)
    assert not outcome.converged
    return outcome.state


@pytest.fixture
def problem(make_problem):
    """9 x 9 nodes at 1 m/s; the film may be in tension, so that nothing is cut."""
    return make_problem(nodes=9, scheme=Scheme(cavitation=False))


@pytest.fixture
def line_problem(make_problem, paper_contact):
    """A line contact on 9 nodes: the printed coefficients, which have no flow across, are all of it."""
    lubricant = paper_contact().lubricant
    contact = LineContact(1859e3, 12.7e-3, 219.78e9, 1.0, lubricant)
    line = {"nodes": 9, "ny": 1, "y": (0.0, 0.0)}
    return make_problem(contact, Scheme(cavitation=False), **line)


def rough(problem):
    """All film: random low pressures in a random gap in which both kinds of flow matter."""
    rng = np.random.default_rng(3)
    P = np.where(problem.boundary, 0.0, 0.02 + 0.02 * rng.random(problem.grid.shape))
    H = 0.15 + 0.1 * rng.random(problem.grid.shape)
    status = np.where(problem.boundary, BOUNDARY, LUBRICATED).astype(np.int8)
    return State(P, 0.0, H, status)


def close(state, *nodes):
    """Overlap at some nodes, which the sweep will take for contact."""
    for node in nodes:
        state.H[node] = -0.01
    return state


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


def assert_line_equation(problem, state, new, node):
    """alpha P_i-1 + beta P_i + gamma P_i+1 = phi with the new pressures of the line."""
    (j, i), (alpha, beta, gamma, phi) = node, printed(problem, state, node)
    terms = alpha * new.P[j, i - 1], beta * new.P[j, i], gamma * new.P[j, i + 1]
    scale = max(map(abs, (*terms, phi)))
    assert sum(terms) == pytest.approx(phi, abs=1e-11 * scale)


def interior(problem):
    return [tuple(node) for node in np.argwhere(~problem.boundary)]


class TestFluidNodes:
    def test_coefficients_of_eq_52_are_those_printed(self, line_problem):
        state = rough(line_problem)
        new = one_sweep(line_problem, state)
        for node in interior(line_problem):
            assert_line_equation(line_problem, state, new, node)
        # The state is not one where a part of them would go unnoticed.
        fluid = line_problem.evaluate(state).fluid
        poiseuille = own(fluid.eps)[0, 4] / line_problem.grid.mesh.dX
        assert 0.05 < poiseuille / (own(fluid.rho)[0, 4] * influence(line_problem)[0]) < 100.0

    def test_flow_across_is_that_of_the_pressures_before_the_sweep(self, problem):
        state = rough(problem)
        new = one_sweep(problem, state)
        for node in interior(problem):
            assert_line_equation(problem, state, new, node)

    @pytest.mark.parametrize("beside", [(4, 3), (4, 5), (3, 4), (5, 4)], ids=["W", "E", "S", "N"])
    def test_closed_faces_drop_their_terms(self, problem, beside):
        state = close(rough(problem), beside)
        new = one_sweep(problem, state)
        assert_line_equation(problem, state, new, NODE)

    def test_by_points_neighbours_keep_their_old_pressures(self, problem):
        """[Liu eq. 36], with the gap's answer to P_i in its denominator."""
        state = rough(problem)
        new = one_sweep(problem, state, replace(WHOLE_WAY, fluid_update="point"))
        inflow = problem.evaluate(state).inflow
        for node in interior(problem):
            _, beta, _, _ = printed(problem, state, node)
            assert new.P[node] - state.P[node] == pytest.approx(-inflow[node] / beta, rel=1e-11)


class TestContactNodes:
    @pytest.mark.parametrize("stability", [1.0, 10.0])
    def test_by_lines_eq_41(self, problem, stability):
        """Both neighbours' changes count, C_c multiplies the node's own."""
        state = close(rough(problem), (4, 3), (4, 4), (4, 5))
        new = one_sweep(problem, state, replace(WHOLE_WAY, stability=stability))
        D, change = influence(problem), new.P - state.P
        for i in (3, 4, 5):
            left = D[1] * change[4, i - 1] + stability * D[0] * change[4, i] + D[1] * change[4, i + 1]
            assert left == pytest.approx(-state.H[4, i], rel=1e-11)

    @pytest.mark.parametrize("stability", [1.0, 10.0])
    def test_by_points_eq_42(self, problem, stability):
        """Only the change of the node before counts: P_new = P - (H + D_1,0 dP_i-1)/(C_c D_0,0)."""
        state = close(rough(problem), (4, 3), (4, 4), (4, 5))
        new = one_sweep(problem, state, replace(WHOLE_WAY, stability=stability, contact_update="point"))
        D, change = influence(problem), new.P - state.P
        for i in (3, 4, 5):
            expected = -(state.H[4, i] + D[1] * change[4, i - 1]) / (stability * D[0])
            assert change[4, i] == pytest.approx(expected, rel=1e-11)

    def test_a_gap_that_is_closed_is_contact_and_one_that_opens_is_film(self, problem):
        state = close(rough(problem), NODE)
        state.status[2, 2] = CONTACT
        relax(problem, state, replace(WHOLE_WAY, max_sweeps=0), lambda sweep: None)
        assert state.status[NODE] == CONTACT and state.status[2, 2] == LUBRICATED


class TestMove:
    """P_new = P + omega (P_new - P): the sign of [Liu eq. 53] mended."""

    def test_film_goes_omega_of_the_way_and_contact_its_share_of_that(self, problem):
        state = close(rough(problem), NODE)
        whole = one_sweep(problem, state).P - state.P
        settings = replace(WHOLE_WAY, omega=0.2, contact_share=0.25)
        part = one_sweep(problem, state, settings).P - state.P
        factor = np.where(state.H > 0.0, 0.2, 0.05)
        np.testing.assert_allclose(part, factor * whole, rtol=1e-10, atol=1e-15)

    def test_tension_is_cut_where_the_film_may_tear(self, make_problem):
        problem = make_problem(nodes=9)
        state = rough(problem)
        state.P *= 0.01
        free = one_sweep(make_problem(nodes=9, scheme=Scheme(cavitation=False)), state).P
        assert free.min() < 0.0
        np.testing.assert_allclose(one_sweep(problem, state).P, np.maximum(free, 0.0), atol=1e-15)


class TestLoad:
    @pytest.mark.parametrize("every, sweeps, corrected", [(1, 1, True), (2, 1, False), (2, 2, True)])
    def test_bodies_approach_while_the_load_is_too_small(self, problem, every, sweeps, corrected):
        """[Liu eq. 54]: H0 - omega_w (2 pi/3 - sum P dX dY), every few sweeps."""
        state = rough(problem)
        settings = replace(WHOLE_WAY, omega=1e-3, load_factor=0.25, load_every=every, max_sweeps=sweeps)
        new = one_sweep(problem, state, settings)
        mesh = problem.grid.mesh
        missing = 2.0 * np.pi / 3.0 - mesh.dX * mesh.dY * new.P.sum()
        assert missing > 0.0
        assert new.H0 == pytest.approx(-0.25 * missing if corrected else 0.0, rel=1e-12)


class TestCavities:
    @pytest.fixture
    def torn(self, make_problem):
        """Film that ends in a widening gap without pressure."""
        problem = make_problem(nodes=9)
        state = rough(problem)
        state.H[:] = 0.15 + 0.02 * np.maximum(np.arange(9) - 3, 0)
        state.P[:, 5:] = 0.0
        return problem, state

    def test_they_keep_no_pressure_and_the_film_beside_them_knows_it(self, torn):
        problem, state = torn
        assert problem.evaluate(state).inflow[4, 6] < 0.0
        new = one_sweep(problem, state)
        np.testing.assert_array_equal(new.P[1:-1, 6:], 0.0)
        for j in range(2, 7):
            for i in range(1, 5):
                if new.P[j, i] > 0.0 and new.P[j, i - 1 : i + 2].min() >= 0.0:
                    assert_line_equation(problem, state, new, (j, i))

    def test_they_are_told_from_film_by_their_inflow(self, torn):
        problem, state = torn
        state.p[:] = state.P
        inflow = problem.evaluate_full(state).inflow
        relax(problem, state, replace(WHOLE_WAY, max_sweeps=0), lambda sweep: None)
        expected = ~problem.boundary & (state.P <= 0.0) & (inflow <= 0.0)
        assert expected.any()
        np.testing.assert_array_equal(state.status == CAVITATED, expected)


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

    @pytest.mark.parametrize("omega", [0.1, 0.2])
    def test_it_finds_the_film_that_newton_finds(self, make_hierarchy, solve, paper_contact, omega):
        contact = paper_contact()
        hierarchy, problem, outcome, told = self.run(make_hierarchy, contact, omega=omega, tolerance=1e-6)
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
