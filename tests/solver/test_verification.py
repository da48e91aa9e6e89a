import numpy as np
import pytest

import mgehl
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
        dome.P[node], mesh = 0.05, tiny_problem.grid.mesh
        cell = min(cell for cell, k in zip((mesh.dY, mesh.dX), node, strict=True) if k in (1, 7))
        assert check_edge(tiny_problem, dome).pressure_ratio == pytest.approx(0.05 * NEAR / cell, rel=1e-14)

    @pytest.mark.parametrize("nodes", [33, 65, 129])
    @pytest.mark.parametrize("half", [0.5, 1.0, 2.0])
    def test_it_goes_by_the_loaded_zone_and_not_by_the_cells(self, make_problem, nodes, half):
        """Of a pressure that rises from all sides in proportion to the distance, and is 4 in the middle."""
        problem = make_problem(nodes=nodes, x=[-4.0, 4.0], y=[-4.0, 4.0])
        mesh = problem.grid.mesh
        from_x, from_y = (np.minimum(at - at[0], at[-1] - at) for at in (mesh.X, mesh.Y))
        P = 0.05 * np.minimum(from_x[None, :], from_y[:, None])
        P[np.maximum(np.abs(mesh.X)[None, :], np.abs(mesh.Y)[:, None]) <= half] = 4.0
        edge = check_edge(problem, State(P, 0.0, np.ones(P.shape), np.ones(P.shape, np.int8)))
        assert edge.pressure_ratio == pytest.approx(0.05 * NEAR * max(half, 1.0) / 4.0, rel=1e-12)

    @pytest.mark.parametrize("ends, is_cut", [((-600.0, 8.0), True), ((-600.0, 20.0), False)])
    def test_a_light_roller_is_cut_downstream(self, ends, is_cut):
        """Its loaded zone is 34 semi-axes wide either way; its films on both domains are 2 % apart."""
        light = {"contact.kind": "line", "contact.load_per_length": 1e3, "lubricant.viscosity": 0.1}
        more = {"motion.speed": 0.5, "grid.x": list(ends), "grid.nodes": 513, "solver.error": False}
        result = mgehl.solve(mgehl.load(None, light | more)).result
        assert result.edge.cuts == is_cut and result.converged != is_cut

    @pytest.mark.parametrize("node", [(0, 4), (8, 4), (4, 0), (4, 8), (0, 0)])
    def test_bodies_that_overlap_on_the_boundary_are_seen(self, tiny_problem, dome, node):
        dome.H[node] = -0.125
        edge = check_edge(tiny_problem, dome)
        assert (edge.overlapping, edge.largest_nm) == (1, 0.125e9 * tiny_problem.contact.film_scale)


def test_of_an_untreated_couette_flow_the_largest_through_a_face_counts(tiny_problem, make_problem, state):
    """1B carries rho H of the node on the left."""
    leaky = make_problem(nodes=9, scheme=Scheme(couette_at_interface="untreated"))

    def leak(problem):
        return closed_face_flow(problem, problem.evaluate(state))

    assert leak(leaky) == 0.0  # without contact no face is closed
    state.status[NODE] = CONTACT
    state.H[4, 3], state.H[NODE], state.H[4, 6] = 1.5, 0.25, 3.0
    assert leak(leaky) == 1.5  # through the west face, not 3 farther on
    state.H[4, 3] = 0.125
    assert leak(leaky) == 0.25  # through the east face, of the solid itself
    assert leak(tiny_problem) == 0.0


@pytest.fixture
def balanced(state):
    """No pressure, and a gap that narrows nowhere: nothing flows into any node."""
    state.status[1:-1, 5:-1] = CAVITATED
    return state


# Changes of the balanced state, (status, P, H) of nodes; what is broken, and by how much.
BROKEN = {
    "tension in a film": ({(4, 2): (LUBRICATED, -0.25, 1.0)}, 0.25),
    "tension in contact": ({(4, 2): (CONTACT, -0.25, 0.0)}, 0.25),  # far from the cavity: it blocks flow
    "flow into the cavity": ({(4, 6): (CAVITATED, 0.0, 0.7)}, 0.3),  # receives 1, passes its gap on
    "flow out of it": ({(4, 7): (CAVITATED, 0.0, 1.3)}, 0.3),
    "contact with a gap": ({(4, 2): (CONTACT, 0.0, 0.125)}, 0.125),
    "contact that overlaps": ({(4, 2): (CONTACT, 0.0, -0.125)}, 0.125),
    "film where bodies overlap": ({(4, 2): (LUBRICATED, 0.0, -0.125)}, 0.125),
    "pressure in the cavity": ({(4, 6): (CAVITATED, 1e-9, 1.0)}, None),
    "fluid shut in": ({(4, 1): (CONTACT, 0.0, 0.0), (4, 3): (CONTACT, 0.0, 0.0)}, None),
}


@pytest.mark.parametrize("nodes, size", BROKEN.values(), ids=BROKEN)
def test_what_breaks_complementarity_is_found_with_its_size(tiny_problem, balanced, nodes, size):
    for node, values in nodes.items():
        balanced.status[node], balanced.P[node], balanced.H[node] = values
    error = complementarity_error(tiny_problem, balanced, tiny_problem.evaluate(balanced))
    assert error >= (1.0 if len(nodes) > 1 else 1e-9)
    assert size is None or error == pytest.approx(size, rel=1e-12)


def test_a_cavity_that_holds_more_than_its_gap(tiny_problem, balanced):
    """What flows in flows out: 1.25 from the film before, and from each cavity."""
    balanced.H[:, 4], balanced.filling[1:-1, 5:-1] = 1.25, 1.25
    error = complementarity_error(tiny_problem, balanced, tiny_problem.evaluate(balanced))
    assert error == pytest.approx(0.25, rel=1e-12)


def test_contact_that_presses_less_than_the_fluid_in_its_layers(make_problem, state):
    """Of one pressure everywhere, with no fluid above the layers: nothing flows."""
    problem = make_problem(nodes=9, scheme=Scheme(contact_law=BoundaryFilm(0.5)))
    state.P[:] = state.p[:] = state.H[:] = 0.5
    state.status[NODE], state.P[NODE] = CONTACT, 0.25
    assert complementarity_error(problem, state, problem.evaluate(state)) == pytest.approx(0.25)


@pytest.mark.parametrize(
    "kind, first, last, imbalance",
    [
        (LUBRICATED, 1, 8, 0.7),  # in through the first face 1.0, out through the last 1.7
        (CAVITATED, 5, 8, 0.4),
        (CONTACT, 5, 6, 0.7),  # takes in 1.0; film behind it passes 1.7 on without any supply
        (CONTACT, 5, 8, 1.0),
    ],
)
def test_flux_imbalance_of_a_film_that_widens(tiny_problem, state, kind, first, last, imbalance):
    """Without pressure a face passes the gap of its upstream node (1B)."""
    state.H[:] = 1.0 + 0.1 * np.arange(9)
    state.status[1:-1, first:last] = kind
    assert flux_imbalance(tiny_problem, tiny_problem.evaluate(state)) == pytest.approx(imbalance)
