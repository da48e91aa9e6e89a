"""What must hold of an answer, on states made by hand."""

import numpy as np
import pytest

from mgehl.discretization.contact_law import BoundaryFilm
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.solver.problem import State
from mgehl.solver.verification import (
    NEAR,
    Edge,
    check_edge,
    closed_face_flow,
    complementarity_error,
    flux_imbalance,
)

NODE = (4, 4)


class TestEdge:
    """A solution in its domain: what lies beyond the boundary was not solved."""

    @pytest.fixture
    def dome(self, state):
        """Pressure over the inner 5 x 5 nodes, 1 in the middle."""
        state.P[2:7, 2:7], state.P[4, 4] = 0.5, 1.0
        return state

    def test_a_contact_inside_holds(self, tiny_problem, dome):
        edge = check_edge(tiny_problem, dome)
        assert edge == Edge(0.0, 0, 0.0, 5, 5)

    @pytest.mark.parametrize("node", [(1, 4), (7, 4), (4, 1), (4, 7), (1, 1), (7, 7)])
    def test_the_pressure_beside_each_side_is_seen(self, tiny_problem, dome, node):
        dome.P[node], mesh = 0.25, tiny_problem.grid.mesh
        cell = min(cell for cell, k in zip((mesh.dY, mesh.dX), node, strict=True) if k in (1, 7))
        assert check_edge(tiny_problem, dome).pressure_ratio == pytest.approx(0.25 * NEAR / cell, rel=1e-14)

    @pytest.mark.parametrize("nodes", [9, 17, 33])
    def test_it_does_not_depend_on_the_cells(self, make_problem, nodes):
        """Of a pressure that rises from all sides in proportion to the distance, to 1.5 in the middle."""
        problem = make_problem(nodes=nodes)
        mesh = problem.grid.mesh
        from_x, from_y = (np.minimum(at - at[0], at[-1] - at) for at in (mesh.X, mesh.Y))
        P = np.minimum(from_x[None, :], from_y[:, None])
        edge = check_edge(problem, State(P, 0.0, np.ones(P.shape), np.ones(P.shape, np.int8)))
        assert edge.pressure_ratio == pytest.approx(NEAR / 1.5, rel=1e-12)

    @pytest.mark.parametrize("node", [(0, 4), (8, 4), (4, 0), (4, 8), (0, 0)])
    def test_bodies_that_overlap_on_the_boundary_are_seen(self, tiny_problem, dome, node):
        dome.H[node] = -0.125
        edge = check_edge(tiny_problem, dome)
        assert (edge.overlapping, edge.largest_nm) == (1, 0.125e9 * tiny_problem.contact.film_scale)


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


class TestComplementarity:
    @pytest.fixture
    def balanced(self, state):
        """No pressure, and a gap that narrows nowhere: nothing flows into any node."""
        state.status[1:-1, 5:-1] = CAVITATED
        return state

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

    def test_a_cavity_that_holds_more_than_its_gap(self, tiny_problem, balanced):
        """What flows in flows out: 1.25 from the film before, and from each cavity."""
        balanced.H[:, 4], balanced.filling[1:-1, 5:-1] = 1.25, 1.25
        error = complementarity_error(tiny_problem, balanced, tiny_problem.evaluate(balanced))
        assert error == pytest.approx(0.25, rel=1e-12)

    def test_contact_that_presses_less_than_the_fluid_in_its_layers(self, make_problem, state):
        """Of one pressure everywhere, with no fluid above the layers: nothing flows."""
        problem = make_problem(nodes=9, scheme=Scheme(contact_law=BoundaryFilm(0.5)))
        state.P[:] = state.p[:] = state.H[:] = 0.5
        state.status[NODE], state.P[NODE] = CONTACT, 0.25
        assert complementarity_error(problem, state, problem.evaluate(state)) == pytest.approx(0.25)

    @pytest.mark.parametrize("node, gap", [(6, 0.7), (7, 1.3)])
    def test_flow_into_the_cavity_or_out_of_it(self, tiny_problem, balanced, node, gap):
        balanced.H[4, node] = gap  # receives 1, passes its gap on
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


@pytest.mark.parametrize("couette", ["1B", "2B", "2C", "S2C"])
def test_conservative_schemes_balance_when_solved(solve, paper_contact, couette):
    solution = solve(paper_contact(), 65, couette=couette)
    assert solution.outcome.converged
    assert solution.problem.scheme.couette == couette
    assert flux_imbalance(solution.problem, solution.problem.evaluate(solution.outcome.state)) < 1e-7
