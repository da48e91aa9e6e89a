"""What must hold of an answer, on states made by hand."""

import numpy as np
import pytest

from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.solver.problem import State
from mgehl.solver.verification import (
    NEAR,
    check_edge,
    complementarity_error,
    flux_imbalance,
)


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

    def test_flow_into_the_cavity(self, tiny_problem, balanced):
        balanced.H[4, 6] = 0.7  # receives 1, passes 0.7 on
        assert complementarity_error(
            tiny_problem, balanced, tiny_problem.evaluate(balanced)
        ) == pytest.approx(0.3, rel=1e-12)


@pytest.mark.parametrize("couette", ["1B", "2B", "2C", "S2C"])
def test_conservative_schemes_balance_when_solved(solve, paper_contact, couette):
    solution = solve(paper_contact(), 65, couette=couette)
    assert solution.outcome.converged
    assert solution.problem.scheme.couette == couette
    assert flux_imbalance(solution.problem, solution.problem.evaluate(solution.outcome.state)) < 1e-7
