from types import SimpleNamespace

import numpy as np
import pytest

from mgehl.discretization.couette import EE, SCHEMES, WW, E, W, add_couette
from mgehl.discretization.faces import Flow
from mgehl.discretization.status import CONTACT, LUBRICATED

# One line of five nodes with small whole numbers, so that every flow is exact.
RHO = np.array([[2.0, 3.0, 5.0, 4.0, 7.0]])
GAP = np.array([[7.0, 11.0, 13.0, 6.0, 2.0]])
SLOPE = np.array([[1.0, 4.0, 2.0, 5.0, 3.0]])


def couette_flows(scheme, linearised=False, fluid=None, status=None, motion=1):
    fluid = fluid or SimpleNamespace(rho=RHO, H=GAP, drho_dP=SLOPE)
    table, flows = SCHEMES[scheme], []
    for terms in (table.leaving, table.entering):
        lines, nx = fluid.rho.shape
        flows.append(Flow((lines, nx - 1), (WW, W, E, EE) if linearised else ()))
        add_couette(flows[-1], terms, table.near, fluid, status, motion)
    return flows


# Through the face between nodes 1 and 2, by Eqs. 17 and 18 with (rho, H) = (2, 7), (3, 11), (5, 13):
#   1B 3*11;  2B (3*33 - 14)/2;  2C (33 + 65)/2;  S1B leaving 33 + (3 - 2) 11, entering
#   33 + (5 - 3) 11;  S2C (33 + 65)/2 - (5 - 3)(13 - 11)/2
@pytest.mark.parametrize(
    "scheme, leaves, enters",
    [("1B", 33.0, 33.0), ("2B", 42.5, 42.5), ("2C", 49.0, 49.0), ("S1B", 44.0, 55.0), ("S2C", 47.0, 47.0)],
)
def test_flow_through_an_inner_face(scheme, leaves, enters):
    leaving, entering = couette_flows(scheme)
    assert leaving.value[0, 1] == leaves
    assert entering.value[0, 1] == enters


@pytest.mark.parametrize(
    "scheme, enters", [("1B", 14.0), ("2B", 23.5), ("2C", 23.5), ("S1B", 21.0), ("S2C", 21.5)]
)
def test_flow_through_the_first_face_needs_no_node_upstream(scheme, enters):
    """1B 2*7;  2B and 2C (14 + 33)/2;  S1B 14 + (3 - 2) 7;  S2C 23.5 - (3 - 2)(11 - 7)/2."""
    assert couette_flows(scheme)[1].value[0, 0] == enters


def difference(scheme):
    """dX d(rho H)/dX of nodes 1, 2, 3: what leaves less what enters."""
    leaving, entering = couette_flows(scheme)
    return (leaving.value[:, 1:] - entering.value[:, :-1])[0]


def test_1B_node_difference_is_eq_8():
    assert difference("1B").tolist() == [33.0 - 14.0, 65.0 - 33.0, 24.0 - 65.0]


def test_2B_node_difference_is_eq_9_and_1B_at_the_first_node():
    second = [(3 * 65 - 4 * 33 + 14) / 2, (3 * 24 - 4 * 65 + 33) / 2]
    assert difference("2B").tolist() == [33.0 - 14.0, *second]


def test_2C_node_difference_is_eq_10():
    assert difference("2C").tolist() == [(65 - 14) / 2, (24 - 33) / 2, (14 - 65) / 2]


def test_S1B_node_difference_is_eq_12():
    """H_i (rho_i - rho_i-1) + rho_i (H_i - H_i-1) at every inner node."""
    drho, dH = np.diff(RHO[0])[:-1], np.diff(GAP[0])[:-1]
    eq_12 = GAP[0, 1:-1] * drho + RHO[0, 1:-1] * dH
    assert difference("S1B").tolist() == eq_12.tolist()
    one_term_more = np.diff(RHO[0] * GAP[0])[:-1] + drho * dH
    assert eq_12.tolist() == one_term_more.tolist()


def test_S2C_node_difference_is_eq_13():
    """H_i (rho_i+1 - rho_i-1)/2 + rho_i (H_i+1 - H_i-1)/2 at every inner node."""
    drho, dH = RHO[0, 2:] - RHO[0, :-2], GAP[0, 2:] - GAP[0, :-2]
    eq_13 = (GAP[0, 1:-1] * drho + RHO[0, 1:-1] * dH) / 2
    assert difference("S2C").tolist() == eq_13.tolist()


def test_S2B_v_node_difference_is_option_v():
    """The other factor is the mean of i - 1 and i + 1; the printed line above Eq. 15."""
    rho, H = RHO[0], GAP[0]
    i = np.array([2])  # the first and the last inner node lack a far one
    backward = [(3 * q[i] - 4 * q[i - 1] + q[i - 2]) / 2 for q in (rho, H)]
    option = (H[i + 1] + H[i - 1]) / 2 * backward[0] + (rho[i + 1] + rho[i - 1]) / 2 * backward[1]
    assert difference("S2B-v")[1:2].tolist() == pytest.approx(option.tolist(), rel=1e-14)


def test_S2B_vi_node_difference_is_option_vi():
    rho, H = RHO[0], GAP[0]
    i = np.array([2, 3])
    backward = [(3 * q[i] - 4 * q[i - 1] + q[i - 2]) / 2 for q in (rho, H)]
    option = H[i] * backward[0] + rho[i] * backward[1]
    assert difference("S2B-vi")[1:].tolist() == pytest.approx(option.tolist(), rel=1e-14)


@pytest.mark.parametrize("scheme", ["2B", "S2B-v", "S2B-vi"])
def test_second_order_backward_schemes_agree_where_the_density_is_constant_and_the_gap_linear(scheme):
    """Each flow then is the face value of H, so none of them adds a constant flow of its own."""
    gap = np.arange(2.0, 7.0)[None, :]
    fluid = SimpleNamespace(rho=np.ones((1, 5)), H=gap, drho_dP=np.zeros((1, 5)))
    for flow in couette_flows(scheme, fluid=fluid):
        assert flow.value[0].tolist() == pytest.approx([2.5, 3.5, 4.5, 5.5], rel=1e-14)


@pytest.mark.parametrize("scheme, flow", [("2B", 49.0), ("S2B-v", 47.0), ("S2B-vi", 47.0), ("S1B", 33.0)])
def test_nothing_is_extrapolated_from_the_far_side_of_a_contact(scheme, flow):
    """With node 0 solid, the face between nodes 1 and 2 uses 2C, S2C or 1B of these two nodes."""
    status = np.full((1, 5), LUBRICATED)
    status[0, 0] = CONTACT
    leaving, _ = couette_flows(scheme, status=status)
    assert leaving.value[0, 1] == pytest.approx(flow, rel=1e-14)
    free, _ = couette_flows(scheme)
    assert leaving.value[0, 1] != free.value[0, 1]
    assert leaving.value[0, 2] == free.value[0, 2]


def test_motion_against_the_differencing_turns_every_flow_round():
    for scheme in SCHEMES:
        with_it, against = couette_flows(scheme), couette_flows(scheme, motion=-1)
        for one, other in zip(with_it, against, strict=True):
            np.testing.assert_array_equal(one.value, -other.value)


def test_schemes_of_a_difference_of_rho_H_are_conservative():
    conservative = [name for name, scheme in SCHEMES.items() if scheme.conservative]
    assert conservative == ["1B", "2B", "2C", "S2C"]


# (c, a, b) of Eqs. 17 and 18 multiplied out; a term adds c rho'_a H_b by P_a and c rho_a by H_b.
@pytest.mark.parametrize(
    "scheme, leaves, enters",
    [
        ("1B", [(1.0, W, W)], [(1.0, W, W)]),
        ("2B", [(1.5, W, W), (-0.5, WW, WW)], [(1.5, W, W), (-0.5, WW, WW)]),
        ("2C", [(0.5, W, W), (0.5, E, E)], [(0.5, W, W), (0.5, E, E)]),
        ("S1B", [(2.0, W, W), (-1.0, WW, W)], [(1.0, E, W)]),
        ("S2C", [(0.5, W, E), (0.5, E, W)], [(0.5, W, E), (0.5, E, W)]),
    ],
)
def test_derivatives_through_an_inner_face(scheme, leaves, enters):
    for flow, terms in zip(couette_flows(scheme, linearised=True), (leaves, enters), strict=True):
        by_P, by_H = np.zeros(4), np.zeros(4)
        for c, a, b in terms:
            # Nodes 0 to 3 are WW, W, E, EE of the face between nodes 1 and 2.
            by_P[a] += c * SLOPE[0, a] * GAP[0, b]
            by_H[b] += c * RHO[0, a]
        assert [array[0, 1] for array in flow.by_P.values()] == by_P.tolist()
        assert [array[0, 1] for array in flow.by_H.values()] == by_H.tolist()


@pytest.mark.parametrize("scheme", SCHEMES)
def test_uniform_fluid_passes_unchanged_by_every_scheme(scheme):
    """With uniform rho and H every face carries rho H."""
    ones = np.ones((2, 5))
    fluid = SimpleNamespace(rho=2.0 * ones, H=3.0 * ones, drho_dP=ones)
    leaving, entering = couette_flows(scheme, fluid=fluid)
    assert (leaving.value == 6.0).all() and (entering.value == 6.0).all()
