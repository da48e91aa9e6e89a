from dataclasses import replace
from math import sqrt

import numpy as np
import pytest

from mgehl.discretization.couette import EE, SCHEMES, WW, E, W
from mgehl.discretization.faces import conductances, x_flows, y_flows
from mgehl.discretization.fluid import FACE_MEANS, Fluid, fluid_state
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, CONTACT, LUBRICATED

every_scheme = pytest.mark.parametrize("scheme", SCHEMES)
every_mean = pytest.mark.parametrize("mean", FACE_MEANS)


def plain_fluid(P, H, rho, eps):
    """A fluid with given density and mobility and no derivatives."""
    zero = np.zeros_like(P)
    return Fluid(P, H, rho, zero, eps, zero, zero)


@pytest.mark.parametrize("mean, eps", [("arithmetic", 5.0), ("geometric", 4.0), ("harmonic", 3.2)])
def test_poiseuille_flow_through_an_x_face(mean, eps):
    """-eps (P_E - P_W)/dX with eps of 2 and 8, P of 1 and 4, dX = 1/2; rho H = 0."""
    mesh = Mesh(3, 3, (0.0, 1.0), (0.0, 2.0))
    line = np.array([[2.0, 8.0, 8.0]])
    fluid = plain_fluid(np.array([[1.0, 4.0, 4.0]]), np.zeros((1, 3)), np.ones((1, 3)), line)
    leaving, entering = x_flows(fluid, np.full((1, 3), LUBRICATED), mesh, Scheme("1B", mean))
    assert leaving.value[0].tolist() == pytest.approx([-eps * 3.0 / 0.5, 0.0], rel=1e-15)
    assert entering is leaving


@pytest.mark.parametrize("mean, eps", [("arithmetic", 5.0), ("geometric", 4.0), ("harmonic", 3.2)])
def test_poiseuille_flow_through_a_y_face(mean, eps):
    """-k_e^2 eps (P_N - P_S)/dY with k_e = 2, dY = 1/4: no Couette flow crosses it."""
    mesh = Mesh(3, 5, (0.0, 1.0), (0.0, 1.0), k_e=2.0)
    ones = np.ones((2, 1))
    fluid = plain_fluid(np.array([[1.0], [4.0]]), ones, ones, np.array([[2.0], [8.0]]))
    flow = y_flows(fluid, np.full((2, 1), LUBRICATED), mesh, Scheme(face_mobility=mean))
    assert flow.value[0, 0] == pytest.approx(-4.0 * eps * 3.0 / 0.25, rel=1e-15)


def arrays_of(flow):
    return (flow.value, *flow.by_P.values(), *flow.by_H.values())


def reaches_across(flow, solid):
    """x faces whose far nodes are solid: they are served by the nodes on their two sides."""
    across = np.zeros(flow.value.shape, dtype=bool)
    if WW in flow.by_P:
        across[:, 1:] |= solid[:, :-2]
    if EE in flow.by_P:
        across[:, :-1] |= solid[:, 2:]
    return across


@every_scheme
def test_contact_closes_a_face_for_both_flows_and_all_derivatives(scheme, mixed, contact):
    """Liu eq. 4: nothing passes a closed face, and the open ones carry what they would without."""
    fluid = fluid_state(mixed.P, mixed.H, contact)
    x = mixed.status == CONTACT
    closed_x, closed_y = x[:, :-1] | x[:, 1:], x[:-1] | x[1:]

    def flows(status):
        across = y_flows(fluid, status, mixed.mesh, Scheme(), True)
        return (*x_flows(fluid, status, mixed.mesh, Scheme(scheme), True), across)

    without = flows(np.where(x, LUBRICATED, mixed.status))
    for flow, free, closed in zip(
        flows(mixed.status), without, (closed_x, closed_x, closed_y), strict=True
    ):
        unlike = closed | reaches_across(flow, x)
        for array, free_array in zip(arrays_of(flow), arrays_of(free), strict=True):
            assert (array[closed] == 0.0).all()
            assert (array[~unlike] == free_array[~unlike]).all()
        assert free.value[closed].all()


@every_mean
@pytest.mark.parametrize("gap", [0.0, 1e-3, -1e-3, -0.1, 0.1])
def test_closed_faces_stay_closed_for_any_gap_of_the_contact_node(mean, gap, contact):
    """-0.1 mirrors the neighbours: the mobilities then cancel, which no mean may let through."""
    mesh = Mesh(5, 5, (-2.0, 2.0), (-2.0, 2.0))
    P, H = np.full((3, 5), 0.3), np.full((3, 5), 0.1)
    P[:, 3:] += 0.1
    status = np.full((3, 5), LUBRICATED)
    H[1, 2], status[1, 2] = gap, CONTACT
    fluid = fluid_state(P, H, contact)
    leaving, _ = x_flows(fluid, status, mesh, Scheme("1B", mean), True)
    across = y_flows(fluid, status, mesh, Scheme(face_mobility=mean), True)
    for flow, faces in ((leaving, leaving.value[1, 1:3]), (across, across.value[:, 2])):
        assert (faces == 0.0).all()
        assert all(np.isfinite(array).all() for array in arrays_of(flow))


# Liu eqs. 20-24: the pressure rise P_i - P_i-1 times eps/dX where the face carries no net flow.
BLOCKED_RISE = {
    "1B": lambda rho, H, i: rho[i - 1] * H[i - 1],
    "2B": lambda rho, H, i: (3.0 * rho[i - 1] * H[i - 1] - rho[i - 2] * H[i - 2]) / 2.0,
    "2C": lambda rho, H, i: (rho[i] * H[i] + rho[i - 1] * H[i - 1]) / 2.0,
    "S1B": lambda rho, H, i: rho[i] * H[i - 1],
    "S2C": lambda rho, H, i: (rho[i] * H[i - 1] + rho[i - 1] * H[i]) / 2.0,
}


@pytest.mark.parametrize("scheme", BLOCKED_RISE)
def test_blocked_flow_recursion(scheme):
    """Pressures by Eqs. 20-24 up to a contact node leave every face of the line without flow."""
    rng = np.random.default_rng(3)
    nx = 9
    mesh = Mesh(nx, 3, (0.0, 4.0), (0.0, 1.0))
    rho, H, eps = rng.uniform(1.0, 1.4, nx), np.linspace(1.0, 0.2, nx), rng.uniform(0.5, 2.0, nx)
    P = np.zeros(nx)
    # The first face has no WW node: 2B falls back on 2C there.
    rules = ["2C" if scheme == "2B" else scheme] + [scheme] * (nx - 2)
    for i, rule in enumerate(rules, start=1):
        P[i] = P[i - 1] + BLOCKED_RISE[rule](rho, H, i) * mesh.dX / (0.5 * (eps[i - 1] + eps[i]))
    status = np.full(nx, LUBRICATED)
    status[0], status[-1] = BOUNDARY, CONTACT
    fluid = plain_fluid(*(array[None, :] for array in (P, H, rho, eps)))
    leaving, entering = x_flows(fluid, status[None, :], mesh, Scheme(scheme))
    assert np.abs(entering.value).max() < 1e-14
    assert leaving.value[0, -1] == 0.0
    if SCHEMES[scheme].conservative:
        assert np.abs(leaving.value).max() < 1e-14
    # ... and the recursion is not empty: pressure climbs towards the block.
    assert (np.diff(P) > 0.1).all()


@pytest.mark.parametrize("scheme, i", [(scheme, i) for scheme in BLOCKED_RISE for i in (2, 3, 5)])
def test_pressure_that_stops_one_face_is_the_recursion_s(scheme, i, film, contact):
    """The face flow is linear in P_i at given mobility: its root is P_i of Eqs. 20-24."""
    mesh, fluid = film.mesh, fluid_state(film.P, film.H, contact)[2:3]

    def entering(P_i):
        P = fluid.P.copy()
        P[0, i] = P_i
        changed = replace(fluid, P=P)
        return x_flows(changed, film.status[2:3], mesh, Scheme(scheme))[1].value[0, i - 1]

    root = entering(0.0) / (entering(0.0) - entering(1.0))
    eps = 0.5 * (fluid.eps[0, i - 1] + fluid.eps[0, i])
    rise = BLOCKED_RISE[scheme](fluid.rho[0], fluid.H[0], i) * mesh.dX / eps
    assert root == pytest.approx(fluid.P[0, i - 1] + rise, rel=1e-12)


def differences_by_node(function, P, H, name, node):
    """Central difference of a flow array by P or H at one node."""
    d = 1e-6 if name == "P" else 1e-7
    values = []
    for sign in (1.0, -1.0):
        changed = {"P": P.copy(), "H": H.copy()}
        changed[name][node] += sign * d
        values.append(function(changed["P"], changed["H"]))
    return (values[0] - values[1]) / (2.0 * d)


def assert_derivatives(flow, function, state, faces_of):
    """Every derivative the flow lists, and no other, agrees with central differences."""
    shape = flow.value.shape
    for name, listed in (("P", flow.by_P), ("H", flow.by_H)):
        scale = max(np.abs(array).max() for array in listed.values())
        for node in np.ndindex(*state.P.shape):
            expected = np.zeros(shape)
            for position in listed:
                face = faces_of(node, position)
                if all(0 <= index < length for index, length in zip(face, shape, strict=True)):
                    expected[face] = listed[position][face]
            measured = differences_by_node(function, state.P, state.H, name, node)
            np.testing.assert_allclose(measured, expected, rtol=1e-6, atol=1e-8 * scale)


@every_mean
@every_scheme
def test_x_flow_derivatives(scheme, mean, state, contact):
    def flow(side):
        return lambda P, H: (
            x_flows(fluid_state(P, H, contact), state.status, state.mesh, Scheme(scheme, mean))[side].value
        )

    fluid = fluid_state(state.P, state.H, contact)
    flows = x_flows(fluid, state.status, state.mesh, Scheme(scheme, mean), True)
    for side in (0, 1):
        # Face i lies between nodes i and i + 1, so node i is its W and node i - 1 its WW.
        assert_derivatives(flows[side], flow(side), state, lambda node, at: (node[0], node[1] + W - at))


@every_mean
def test_y_flow_derivatives(mean, state, contact):
    scheme = Scheme(face_mobility=mean)

    def flow(P, H):
        return y_flows(fluid_state(P, H, contact), state.status, state.mesh, scheme).value

    across = y_flows(fluid_state(state.P, state.H, contact), state.status, state.mesh, scheme, True)
    assert set(across.by_P) == set(across.by_H) == {W, E}
    assert_derivatives(across, flow, state, lambda node, at: (node[0] + W - at, node[1]))


def test_values_do_not_depend_on_whether_derivatives_are_asked_for(mixed, contact):
    fluid = fluid_state(mixed.P, mixed.H, contact)
    plain, linearised = (
        [
            flow.value
            for flow in (
                *x_flows(fluid, mixed.status, mixed.mesh, Scheme("S1B", "geometric"), derivatives),
                y_flows(fluid, mixed.status, mixed.mesh, Scheme("S1B", "geometric"), derivatives),
            )
        ]
        for derivatives in (False, True)
    )
    for one, other in zip(plain, linearised, strict=True):
        np.testing.assert_array_equal(one, other)


def test_geometric_mean_of_a_nearly_closed_gap_throttles_the_flow():
    """eps of 1e-10 beside 1: the arithmetic mean leaks 0.5, the geometric 1e-5, the harmonic 2e-10."""
    mesh = Mesh(3, 3, (0.0, 2.0), (0.0, 2.0))
    fluid = plain_fluid(
        np.array([[1.0, 0.0, 0.0]]), np.zeros((1, 3)), np.ones((1, 3)), np.array([[1.0, 1e-10, 1e-10]])
    )
    leak = {
        mean: x_flows(fluid, np.full((1, 3), LUBRICATED), mesh, Scheme("1B", mean))[0].value[0, 0]
        for mean in FACE_MEANS
    }
    expected = {"arithmetic": 0.5 + 0.5e-10, "geometric": sqrt(1e-10), "harmonic": 2e-10 / (1.0 + 1e-10)}
    assert leak == pytest.approx(expected, rel=1e-14)


OPTIONS = {
    "untreated": {"couette_at_interface": "untreated"},
    "against": {"motion": -1},
    "floor": {"gap_floor": 0.1},
    "unified": {"couette_at_interface": "untreated", "motion": -1, "gap_floor": 0.1},
    "geometric share": {"face_mobility": "geometric", "mobility_share": 0.4},
    "harmonic share": {"face_mobility": "harmonic", "mobility_share": 0.4},
}
"""Choices of a `Scheme` beside the two tables; the states' gaps lie on both sides of the floor."""


@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
@every_scheme
def test_x_flow_derivatives_of_options(scheme, options, state, contact):
    scheme = Scheme(scheme, **options)

    def flows(P, H, linearised=False):
        fluid = fluid_state(P, H, contact, scheme.gap_floor)
        return x_flows(fluid, state.status, state.mesh, scheme, linearised)

    for side, flow in enumerate(flows(state.P, state.H, True)):
        values = lambda P, H, side=side: flows(P, H)[side].value  # noqa: E731
        assert_derivatives(flow, values, state, lambda node, at: (node[0], node[1] + W - at))


@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
def test_y_flow_derivatives_of_options(options, state, contact):
    scheme = Scheme(**options)

    def flow(P, H, linearised=False):
        fluid = fluid_state(P, H, contact, scheme.gap_floor)
        return y_flows(fluid, state.status, state.mesh, scheme, linearised)

    assert_derivatives(
        flow(state.P, state.H, True),
        lambda P, H: flow(P, H).value,
        state,
        lambda node, at: (node[0] + W - at, node[1]),
    )


@pytest.mark.parametrize("mean", ["geometric", "harmonic"])
def test_flows_and_conductances_take_their_share_of_the_mean(mean, mixed, contact):
    """They are linear in the face's mobility: 0.4 of those by the mean and 0.6 of the arithmetic ones."""
    fluid = fluid_state(mixed.P, mixed.H, contact)

    def parts(name, share=1.0):
        scheme = Scheme("2B", name, share)
        leaving, _ = x_flows(fluid, mixed.status, mixed.mesh, scheme)
        across = y_flows(fluid, mixed.status, mixed.mesh, scheme)
        return leaving.value, across.value, *conductances(fluid.eps, mixed.status, mixed.mesh, scheme)

    for shared, own, paper in zip(parts(mean, 0.4), parts(mean), parts("arithmetic"), strict=True):
        np.testing.assert_allclose(shared, 0.4 * own + 0.6 * paper, rtol=1e-13, atol=1e-15)
        assert np.abs(own - paper).max() > 1e-4 * np.abs(paper).max()


@every_scheme
def test_untreated_interface_stops_poiseuille_flow_only(scheme, mixed, contact):
    """Every face keeps the Couette flow that a fluid without mobility has, closed ones nothing else."""
    untreated = Scheme(scheme, couette_at_interface="untreated")
    fluid = fluid_state(mixed.P, mixed.H, contact)
    no_contact = np.full_like(mixed.status, LUBRICATED)
    immobile = replace(fluid, eps=np.zeros_like(fluid.eps))
    couette = x_flows(immobile, no_contact, mixed.mesh, untreated)
    both = x_flows(fluid, no_contact, mixed.mesh, untreated)
    solid = mixed.status == CONTACT
    closed = solid[:, :-1] | solid[:, 1:]
    flows = x_flows(fluid, mixed.status, mixed.mesh, untreated)
    for flow, carried, free in zip(flows, couette, both, strict=True):
        np.testing.assert_array_equal(flow.value[closed], carried.value[closed])
        np.testing.assert_array_equal(flow.value[~closed], free.value[~closed])
        assert flow.value[closed].any() and (free.value != carried.value)[closed].all()


def test_untreated_interface_stops_the_flow_between_lines(mixed, contact):
    """No Couette flow crosses a y face: both treatments are one there."""
    fluid = fluid_state(mixed.P, mixed.H, contact)
    closed, untreated = (
        y_flows(fluid, mixed.status, mixed.mesh, Scheme(couette_at_interface=name)).value
        for name in ("closed", "untreated")
    )
    np.testing.assert_array_equal(closed, untreated)
    solid = mixed.status == CONTACT
    assert (untreated[solid[:-1] | solid[1:]] == 0.0).all()


@every_scheme
def test_motion_turns_the_couette_flow_round_and_nothing_else(scheme, mixed, contact):
    """Flows with and against the motion: their mean is the Poiseuille flow, half their difference rho H."""
    fluid = fluid_state(mixed.P, mixed.H, contact)
    immobile = replace(fluid, eps=np.zeros_like(fluid.eps))
    still = replace(fluid, rho=np.zeros_like(fluid.rho))
    forth = x_flows(fluid, mixed.status, mixed.mesh, Scheme(scheme))
    back = x_flows(fluid, mixed.status, mixed.mesh, Scheme(scheme, motion=-1))
    couette = x_flows(immobile, mixed.status, mixed.mesh, Scheme(scheme))
    poiseuille = x_flows(still, mixed.status, mixed.mesh, Scheme(scheme))
    for one, other, carried, driven in zip(forth, back, couette, poiseuille, strict=True):
        np.testing.assert_allclose(one.value + other.value, 2.0 * driven.value, rtol=1e-13, atol=1e-15)
        np.testing.assert_allclose(one.value - other.value, 2.0 * carried.value, rtol=1e-13, atol=1e-15)


def test_edges_shorten_the_distance_of_the_pressures_only():
    """-eps (P_E - P_W)/(dX/2) through the first face, whose Couette flow knows nothing of it."""
    P, H = np.array([[0.0, 1.0, 3.0]]), np.array([[2.0, 4.0, 8.0]])
    fluid = plain_fluid(P, H, np.ones((1, 3)), np.full((1, 3), 3.0))
    mesh = Mesh(3, 1, (0.0, 2.0), (0.0, 0.0), edges=(0.5, 1.75))
    status = np.full((1, 3), LUBRICATED)
    assert x_flows(fluid, status, mesh, Scheme())[0].value.tolist() == [[2.0 - 3.0 / 0.5, 4.0 - 6.0 / 0.75]]
