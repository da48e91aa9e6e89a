import numpy as np
import pytest
from handmade import walled

from mgehl.discretization.axes import axes_of, own
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.rows import FLOW, GAP, PRESSURE, rows_of
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED, enclosed

MESH = Mesh(5, 3, (0.0, 4.0), (0.0, 2.0))
ALONG_X, _ = axes_of(MESH, (1.0, 0.0))

# Number, label and closed faces of the neighbourhoods of Liu sec. 3.2.2-3.2.5. A label says on
# which side of the contact the node lies (1-8), or which border is open (11-14).
NEIGHBOURHOODS = [
    (1, "west", {"east"}), (2, "east", {"west"}), (3, "north", {"south"}), (4, "south", {"north"}),
    (5, "northwest", {"east", "south"}), (6, "northeast", {"west", "south"}),
    (7, "southwest", {"east", "north"}), (8, "southeast", {"west", "north"}),
    (9, "horizontal channel", {"south", "north"}), (10, "vertical channel", {"west", "east"}),
    (11, "west open", {"east", "south", "north"}), (12, "east open", {"west", "south", "north"}),
    (13, "north open", {"west", "east", "south"}), (14, "south open", {"west", "east", "north"}),
]  # fmt: skip
NEIGHBOUR = {"west": (1, 1), "east": (1, 3), "south": (0, 2), "north": (2, 2)}
"""Line and node of the neighbours of node (1, 2) in three lines of five nodes."""

neighbourhoods = pytest.mark.parametrize(
    "number, closed",
    [(number, closed) for number, _, closed in NEIGHBOURHOODS],
    ids=[label for _, label, _ in NEIGHBOURHOODS],
)


def neighbourhood(closed, centre=LUBRICATED):
    """Three lines of five nodes whose node (1, 2) has solid contact across the `closed` faces."""
    status = np.full((3, 5), LUBRICATED)
    status[1, 2] = centre
    for face in closed:
        status[NEIGHBOUR[face]] = CONTACT
    return status


MOTIONS = {
    "along x": ((1.0, 0.0), {10, 13, 14}),
    "against x": ((-1.0, 0.0), {10, 13, 14}),
    "along y": ((0.0, 1.0), {9, 11, 12}),
    "at an angle": ((0.8, -0.6), set()),
}
"""The neighbourhoods of NEIGHBOURHOODS that are shut in, by the motion's direction."""


@neighbourhoods
@pytest.mark.parametrize("motion, shut_in", MOTIONS.values(), ids=MOTIONS)
@pytest.mark.parametrize("centre", [LUBRICATED, CAVITATED])
def test_fluid_is_shut_in_from_both_sides_along_the_motion(number, closed, motion, shut_in, centre):
    """Cases 10, 13 and 14 are processed as solid contact (sec. 3.2.5, last paragraph)."""
    status = neighbourhood(closed, centre)
    expected = np.zeros(status.shape, bool)
    expected[1, 2] = number in shut_in
    found = enclosed(walled(status), axes_of(MESH, motion))
    np.testing.assert_array_equal(found, expected)


def test_gaps_of_one_node_are_shut_in_wider_ones_and_the_boundary_s_are_not():
    """What is shut in has contact on both sides already: a second pass finds nothing."""
    K, F, V, B = CONTACT, LUBRICATED, CAVITATED, BOUNDARY
    status = walled(np.array([[F, K, F, K, V, K, F, F, K, F], [B, K, B, K, F, F, V, K, V, B]]))
    before = status.copy()
    shut_in = enclosed(status, (ALONG_X,))
    assert np.argwhere(shut_in).tolist() == [[0, 2], [0, 4]]
    np.testing.assert_array_equal(status, before)
    own(status)[shut_in] = CONTACT
    assert not enclosed(status, (ALONG_X,)).any()


def test_a_wall_shuts_nothing_in():
    """One node of film between contact and the end of the domain, or between two walls."""
    status = walled(np.array([[LUBRICATED] * 3, [CONTACT] * 3]))
    assert not enclosed(status, axes_of(MESH, (0.0, 1.0))).any()
    assert not enclosed(walled(np.full((1, 3), LUBRICATED)), axes_of(MESH, (0.0, 1.0))).any()


def test_the_status_says_which_equation_a_node_has():
    every = np.array([[BOUNDARY, LUBRICATED, CAVITATED, CONTACT]])
    assert rows_of(every).tolist() == [[PRESSURE, FLOW, PRESSURE, GAP]]
