"""What must hold of an answer, on states made by hand."""

import numpy as np
import pytest

from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.solver.problem import State
from mgehl.solver.verification import (
    FEWEST_NODES,
    LARGEST_EDGE_PRESSURE,
    NEAR,
    SAFETY,
    check_edge,
    check_interface,
    check_pressure_inequality,
    closed_face_flow,
    complementarity_error,
    flux_imbalance,
)

NODE = (4, 4)


@pytest.fixture
def state(tiny_problem):
    """All film without pressure and a gap of 1."""
    shape = tiny_problem.grid.shape
    status = np.where(tiny_problem.boundary, BOUNDARY, LUBRICATED).astype(np.int8)
    return State(np.zeros(shape), 0.0, np.ones(shape), status)


class TestInterface:
    """Eq. 2 at the face between film and contact, along x and y."""

    @pytest.fixture(params=["along x", "along y"])
    def across(self, request, state):
        """Function: the state with these pressures of nodes 1 to 6, film and from node 4 on contact."""

        def make(P):
            for array, values in ((state.P, P), (state.status, [LUBRICATED] * 3 + [CONTACT] * 3)):
                (array.T if request.param == "along y" else array)[:, 1:7] = values
            return state

        return make

    @pytest.mark.parametrize("slope", [0.1, -0.1])
    def test_a_pressure_that_goes_on_through_the_interface_holds(self, tiny_problem, across, slope):
        """Falling, it breaks the comparison of the nodes."""
        state = across(1.0 + slope * np.arange(6))
        assert check_interface(tiny_problem, state).violations == []
        at_nodes = {(each.i, each.j) for each in check_pressure_inequality(tiny_problem, state).violations}
        assert bool(at_nodes & ({(5, j) for j in range(1, 10)} | {(i, 5) for i in range(1, 10)})) == (
            slope < 0.0
        )

    @pytest.mark.parametrize("slope", [0.1, 0.0, -0.1])
    def test_a_jump_to_less_pressure_is_found(self, tiny_problem, across, slope):
        """Of 0.5; each side's step to the face, half of the slope, may be wrong by more than its size."""
        P = 1.0 + slope * np.arange(6)
        P[3:] -= 0.5
        result = check_interface(tiny_problem, across(P))
        assert len(result.violations) >= 7 and result.worst == pytest.approx(0.5 - SAFETY * abs(slope))

    def test_the_edge_of_a_dry_contact_in_fluid_of_one_pressure_holds(self, tiny_problem, across):
        """p0, and p0 + sqrt of the distance inside, wherever the edge lies between the nodes."""
        for inside in (1e-6, 0.01, 0.1, 0.5, 0.99):
            P = np.r_[np.full(3, 0.3), 0.3 + np.sqrt(inside + np.arange(3.0))]
            assert check_interface(tiny_problem, across(P)).violations == []

    @pytest.mark.parametrize("behind, found", [(0.0, False), (0.24, False), (0.26, True), (0.6, True)])
    def test_contact_one_node_wide(self, tiny_problem, state, behind, found):
        """The pressure that falls through it breaks nothing; fluid that presses from both sides does."""
        state.P[:], state.P[:, 5:] = 0.8, behind
        state.P[3, 4], state.P[4, 4], state.P[5, 4], state.P[6, 4] = 0.2, 0.25, 0.3, 0.35
        state.status[4, 4] = CONTACT
        assert bool(check_interface(tiny_problem, state).violations) == found

    def test_a_gap_that_opens_at_once_says_how_far_its_pressures_may_be_off(self, tiny_problem, across):
        """A wake's edge: half of its step on either side is what a node's pressure of 0.3 deflects."""
        P = np.r_[np.full(3, 0.8), np.full(3, 0.4)]
        state = across(P)
        state.H[state.status == CONTACT], state.H[state.status != CONTACT] = 0.0, 0.3 * tiny_problem.K00
        assert check_interface(tiny_problem, state).worst == pytest.approx(0.4 - SAFETY * 0.3)

    def test_a_pressure_that_turns_near_the_interface_holds(self, tiny_problem, across):
        """0.03 from node to node, and no jump: the curvature of 0.04 on the fluid's side says so."""
        state = across(np.array([0.79, 0.84, 0.835, 0.80, 0.79, 0.79]))
        assert check_interface(tiny_problem, state).violations == []

    def test_without_contact_nothing_is_checked(self, tiny_problem, state):
        assert check_interface(tiny_problem, state).checked == 0


class TestEdge:
    """A solution in its domain: what lies beyond the boundary was not solved."""

    @pytest.fixture
    def dome(self, state):
        """Pressure over the inner 5 x 5 nodes, 1 in the middle."""
        state.P[2:7, 2:7], state.P[4, 4] = 0.5, 1.0
        return state

    def test_a_contact_inside_holds(self, tiny_problem, dome):
        edge = check_edge(tiny_problem, dome)
        assert (edge.pressure, edge.overlapping, edge.largest_overlap, edge.across) == (0.0, 0, 0.0, (5, 5))

    @pytest.mark.parametrize("node", [(1, 4), (7, 4), (4, 1), (4, 7), (1, 1), (7, 7)])
    def test_the_pressure_beside_each_side_is_seen(self, tiny_problem, dome, node):
        dome.P[node], mesh = 0.25, tiny_problem.grid.mesh
        cell = min(cell for cell, k in zip((mesh.dY, mesh.dX), node, strict=True) if k in (1, 7))
        assert check_edge(tiny_problem, dome).pressure == pytest.approx(0.25 * NEAR / cell, rel=1e-14)

    @pytest.mark.parametrize("nodes", [9, 17, 33])
    def test_it_does_not_depend_on_the_cells(self, make_problem, nodes):
        """Of a pressure that rises from all sides in proportion to the distance, to 1.5 in the middle."""
        problem = make_problem(nodes=nodes)
        mesh = problem.grid.mesh
        from_x, from_y = (np.minimum(at - at[0], at[-1] - at) for at in (mesh.X, mesh.Y))
        P = np.minimum(from_x[None, :], from_y[:, None])
        edge = check_edge(problem, State(P, 0.0, np.ones(P.shape), np.ones(P.shape, np.int8)))
        assert edge.pressure == pytest.approx(NEAR / 1.5, rel=1e-12)

    @pytest.mark.parametrize("node", [(0, 4), (8, 4), (4, 0), (4, 8), (0, 0)])
    def test_bodies_that_overlap_on_the_boundary_are_seen(self, tiny_problem, dome, node):
        dome.H[node] = -0.125
        edge = check_edge(tiny_problem, dome)
        assert (edge.overlapping, edge.largest_overlap) == (1, 0.125)

    def test_a_contact_has_as_many_nodes_as_carry_its_load(self, tiny_problem, state):
        state.P[3:5, 2:7], state.P[6, 6] = 1.0, 0.09
        assert check_edge(tiny_problem, state).across == (5, 2)

    def test_without_pressure_nothing_is_divided_by_it(self, tiny_problem, state):
        assert check_edge(tiny_problem, state).pressure == 0.0

    def test_its_limits_leave_room_for_what_was_measured(self):
        assert 6.4e-3 < LARGEST_EDGE_PRESSURE < 1.5e-2 and 3 < FEWEST_NODES <= 7


class TestPressureInequality:
    def test_without_contact_nothing_is_checked(self, tiny_problem, state):
        result = check_pressure_inequality(tiny_problem, state)
        assert (result.checked, result.violations, result.worst) == (0, [], 0.0)

    @pytest.mark.parametrize("beside", [(2, 4), (2, 6), (1, 5), (3, 5)], ids=["W", "E", "S", "N"])
    def test_a_violation_on_each_side(self, tiny_problem, state, beside):
        state.status[2, 5], state.P[2, 5] = CONTACT, 0.5
        state.P[beside] = 0.75
        result = check_pressure_inequality(tiny_problem, state)
        assert result.checked == 1
        (violation,) = result.violations
        assert (violation.i, violation.j) == (6, 3)  # counted from 1
        assert violation.size == result.worst == 0.25

    def test_the_largest_of_several_neighbours_counts(self, tiny_problem, state):
        state.status[NODE], state.P[NODE] = CONTACT, 0.5
        state.P[4, 3], state.P[4, 5], state.P[5, 4] = 0.6, 0.8, 0.7
        result = check_pressure_inequality(tiny_problem, state)
        assert [violation.size for violation in result.violations] == [pytest.approx(0.3)]

    def test_several_violations_are_all_named(self, tiny_problem, state):
        for i in (2, 6):
            state.status[4, i], state.P[4, i] = CONTACT, 0.1
        state.P[4, 4], state.P[3, 6], state.P[3, 2] = 1.0, 0.4, 0.2
        result = check_pressure_inequality(tiny_problem, state)
        places = {(each.i, each.j): each.size for each in result.violations}
        assert places == {(3, 5): pytest.approx(0.1), (7, 5): pytest.approx(0.3)}
        assert result.worst == pytest.approx(0.3)

    def test_equal_pressures_hold(self, tiny_problem, state):
        state.status[NODE], state.P[NODE], state.P[4, 3] = CONTACT, 0.5, 0.5
        result = check_pressure_inequality(tiny_problem, state)
        assert (result.checked, result.violations) == (1, [])

    def test_contact_inside_contact_is_not_interface(self, tiny_problem, state):
        state.status[3:6, 3:6], state.P[3:6, 3:6] = CONTACT, 0.9
        state.P[NODE] = 0.1
        result = check_pressure_inequality(tiny_problem, state)
        assert (result.checked, result.violations) == (8, [])


class TestLargestRatio:
    """Fluid pressure over the contact pressure beside it."""

    def ratio(self, problem, state):
        return check_pressure_inequality(problem, state).largest_ratio

    def test_without_contact_or_fluid_pressure_it_is_zero(self, tiny_problem, state):
        assert self.ratio(tiny_problem, state) == 0.0
        state.status[NODE] = CONTACT
        assert self.ratio(tiny_problem, state) == 0.0

    def test_of_several_nodes_the_largest_counts_violation_or_not(self, tiny_problem, state):
        state.status[4, 2] = state.status[4, 6] = CONTACT
        state.P[4, 2], state.P[4, 1], state.P[3, 2] = 0.5, 0.25, 0.375
        assert self.ratio(tiny_problem, state) == 0.75
        state.P[4, 6], state.P[4, 7] = 0.25, 0.5
        assert self.ratio(tiny_problem, state) == 2.0

    def test_contact_inside_contact_does_not_count(self, tiny_problem, state):
        state.status[3:6, 3:6], state.P[3:6, 3:6] = CONTACT, 0.5
        state.P[NODE], state.P[4, 2] = 0.001, 0.25
        assert self.ratio(tiny_problem, state) == 0.5

    def test_beside_contact_without_pressure_it_is_infinite(self, tiny_problem, state):
        state.status[NODE], state.P[4, 3] = CONTACT, 1e-9
        assert self.ratio(tiny_problem, state) == np.inf


class TestClosedFaceFlow:
    """What an untreated Couette flow leaks: 1B carries rho H of the node on the left."""

    @pytest.fixture
    def leaky_problem(self, make_problem):
        return make_problem(nodes=9, scheme=Scheme(couette_at_interface="untreated"))

    def test_without_contact_no_face_is_closed(self, leaky_problem, state):
        assert closed_face_flow(leaky_problem, leaky_problem.evaluate(state)) == 0.0

    def test_the_largest_flow_through_a_closed_face_counts(self, tiny_problem, leaky_problem, state):
        state.status[NODE] = CONTACT
        state.H[4, 3], state.H[NODE], state.H[4, 6] = 1.5, 0.25, 3.0
        assert (
            closed_face_flow(leaky_problem, leaky_problem.evaluate(state)) == 1.5
        )  # through the west face, not 3 farther on
        state.H[4, 3] = 0.125
        assert (
            closed_face_flow(leaky_problem, leaky_problem.evaluate(state)) == 0.25
        )  # through the east face, of the solid itself
        assert closed_face_flow(tiny_problem, tiny_problem.evaluate(state)) == 0.0

    def test_motion_against_the_differencing_leaks_as_much(self, make_problem, state):
        problem = make_problem(nodes=9, scheme=Scheme(couette_at_interface="untreated", motion=(-1.0, 0.0)))
        state.status[NODE], state.H[4, 3], state.H[NODE] = CONTACT, 1.5, 0.0
        assert closed_face_flow(problem, problem.evaluate(state)) == 1.5

    def test_poiseuille_flow_is_stopped_in_any_case(self, leaky_problem, state):
        state.status[NODE], state.H[:] = CONTACT, 0.5
        state.P[4, 3] = state.P[3, 4] = 0.1
        P = state.P[4, 3]
        rho = leaky_problem.contact.lubricant.density_law.density(P, leaky_problem.contact.hertz.p_h)[0]
        assert closed_face_flow(leaky_problem, leaky_problem.evaluate(state)) == pytest.approx(
            0.5 * rho, rel=1e-14
        )


class TestComplementarity:
    @pytest.fixture
    def balanced(self, state):
        """No pressure, and a gap that narrows nowhere: nothing flows into any node."""
        state.status[1:-1, 5:-1] = CAVITATED
        return state

    def test_a_state_without_breaches(self, tiny_problem, balanced):
        assert complementarity_error(tiny_problem, balanced, tiny_problem.evaluate(balanced)) < 1e-12

    @pytest.mark.parametrize("status", [LUBRICATED, CONTACT])
    def test_tension(self, tiny_problem, balanced, status):
        balanced.status[4, 2], balanced.P[4, 2] = status, -0.25
        balanced.H[4, 2] = 0.0 if status == CONTACT else 1.0
        # Contact also blocks the flow: the cavity is far from it.
        assert complementarity_error(
            tiny_problem, balanced, tiny_problem.evaluate(balanced)
        ) == pytest.approx(0.25)

    def test_pressure_in_the_cavity(self, tiny_problem, balanced):
        balanced.P[4, 6] = 1e-9
        assert complementarity_error(tiny_problem, balanced, tiny_problem.evaluate(balanced)) >= 1e-9

    def test_flow_into_the_cavity(self, tiny_problem, balanced):
        balanced.H[4, 6] = 0.7  # receives 1, passes 0.7 on
        assert complementarity_error(
            tiny_problem, balanced, tiny_problem.evaluate(balanced)
        ) == pytest.approx(0.3, rel=1e-12)

    @pytest.mark.parametrize("gap", [0.125, -0.125])
    def test_contact_with_a_gap_or_an_overlap(self, tiny_problem, balanced, gap):
        balanced.status[4, 2], balanced.H[4, 2] = CONTACT, gap
        assert complementarity_error(
            tiny_problem, balanced, tiny_problem.evaluate(balanced)
        ) == pytest.approx(0.125)

    def test_film_where_the_bodies_overlap(self, tiny_problem, balanced):
        balanced.H[4, 2] = -0.125
        assert complementarity_error(
            tiny_problem, balanced, tiny_problem.evaluate(balanced)
        ) == pytest.approx(0.125)

    def test_fluid_shut_in(self, tiny_problem, balanced):
        balanced.status[4, 1] = balanced.status[4, 3] = CONTACT
        balanced.H[4, 1] = balanced.H[4, 3] = 0.0
        assert complementarity_error(tiny_problem, balanced, tiny_problem.evaluate(balanced)) >= 1.0


class TestFluxImbalance:
    """Without pressure a face passes the gap of its upstream node (1B)."""

    @pytest.fixture
    def widening(self, state):
        state.H[:] = 1.0 + 0.1 * np.arange(9)
        return state

    def test_parallel_gap(self, tiny_problem, state):
        assert flux_imbalance(tiny_problem, tiny_problem.evaluate(state)) < 1e-14

    def test_film_up_to_the_edges_of_the_domain(self, tiny_problem, widening):
        # In through the first face 1.0, out through the last 1.7.
        assert flux_imbalance(tiny_problem, tiny_problem.evaluate(widening)) == pytest.approx(0.7)

    def test_film_that_ends_at_a_cavity(self, tiny_problem, widening):
        widening.status[1:-1, 5:-1] = CAVITATED
        assert flux_imbalance(tiny_problem, tiny_problem.evaluate(widening)) == pytest.approx(0.4)

    def test_contact_lets_nothing_through(self, tiny_problem, widening):
        widening.status[1:-1, 5] = CONTACT
        # Film before the contact takes in 1.0; film behind it passes 1.7 on without any supply.
        assert flux_imbalance(tiny_problem, tiny_problem.evaluate(widening)) == pytest.approx(0.7)
        widening.status[1:-1, 5:-1] = CONTACT
        assert flux_imbalance(tiny_problem, tiny_problem.evaluate(widening)) == pytest.approx(1.0)

    def test_flow_across_the_motion(self, tiny_problem, state):
        mesh, contact = tiny_problem.grid.mesh, tiny_problem.contact
        p = 1e-3
        state.P[1, 4] = p  # beside the first line, where the pressure is zero
        rho = contact.lubricant.density_law.density(p, contact.hertz.p_h)[0]
        log_eta = contact.lubricant.viscosity_law.log_viscosity(p, contact.hertz.p_h)[0]
        mobility = 0.5 * (1.0 + rho * np.exp(-log_eta)) / contact.lambda_
        out = mobility * p / mesh.dY * mesh.dX
        assert flux_imbalance(tiny_problem, tiny_problem.evaluate(state)) == pytest.approx(
            out / (7 * mesh.dY), rel=1e-12
        )

    def test_no_film_no_imbalance(self, tiny_problem, state):
        state.status[1:-1, 1:-1] = CONTACT
        assert flux_imbalance(tiny_problem, tiny_problem.evaluate(state)) == 0.0


@pytest.mark.parametrize("couette", ["1B", "2B", "2C", "S2C"])
def test_conservative_schemes_balance_when_solved(solve, paper_contact, couette):
    solution = solve(paper_contact(), 65, couette=couette)
    assert solution.outcome.converged
    assert solution.problem.scheme.couette == couette
    assert flux_imbalance(solution.problem, solution.problem.evaluate(solution.outcome.state)) < 1e-7


def test_solutions_pass(solve, paper_contact):
    for speed, start in ((1.0, "film"), (5e-6, "contact")):
        solution = solve(paper_contact(speed), 65, start=start)
        state, problem = solution.outcome.state, solution.problem
        assert complementarity_error(problem, state, problem.evaluate(state)) < 1e-7
        assert flux_imbalance(problem, problem.evaluate(state)) < 1e-7
        assert check_pressure_inequality(problem, state).violations == []
