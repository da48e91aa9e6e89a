import numpy as np
import pytest

from mgehl.discretization.status import (
    BOUNDARY,
    CAVITATED,
    CONTACT,
    LUBRICATED,
    NAMES,
    beside_contact,
    close_gaps,
    enclosed,
    largest_fluid_neighbour,
    open_x_faces,
    open_y_faces,
)

# Number, label and closed faces of the neighbourhoods of Liu sec. 3.2.2-3.2.5. A label says on
# which side of the contact the node lies (1-8), or which border is open (11-14).
NEIGHBOURHOODS = [
    (1, "west", {"east"}),
    (2, "east", {"west"}),
    (3, "north", {"south"}),
    (4, "south", {"north"}),
    (5, "northwest", {"east", "south"}),
    (6, "northeast", {"west", "south"}),
    (7, "southwest", {"east", "north"}),
    (8, "southeast", {"west", "north"}),
    (9, "horizontal channel", {"south", "north"}),
    (10, "vertical channel", {"west", "east"}),
    (11, "west open", {"east", "south", "north"}),
    (12, "east open", {"west", "south", "north"}),
    (13, "north open", {"west", "east", "south"}),
    (14, "south open", {"west", "east", "north"}),
]
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


def test_codes_index_the_names():
    assert [NAMES[code] for code in (BOUNDARY, LUBRICATED, CAVITATED, CONTACT)] == [
        "boundary", "lubricated", "cavitated", "contact",
    ]  # fmt: skip


@neighbourhoods
def test_closed_faces_of_each_neighbourhood(number, closed):
    """Exactly the faces that the paper's case lists are closed."""
    status = neighbourhood(closed)
    x, y = open_x_faces(status)[1], open_y_faces(status)[:, 2]
    is_open = {"west": x[1], "east": x[2], "south": y[0], "north": y[1]}
    assert {face for face, through in is_open.items() if not through} == closed


@neighbourhoods
@pytest.mark.parametrize("centre", [LUBRICATED, CAVITATED])
def test_only_nodes_shut_in_from_west_and_east_become_contact(number, closed, centre):
    """Cases 10, 13 and 14 are processed as solid contact (sec. 3.2.5, last paragraph)."""
    status = neighbourhood(closed, centre)
    turned = close_gaps(status)
    shut_in = number in (10, 13, 14)
    assert turned == shut_in
    assert status[1, 2] == (CONTACT if shut_in else centre)


def test_face_is_closed_by_either_node_and_by_contact_only():
    line = np.array([[BOUNDARY, CONTACT, CONTACT, CAVITATED, LUBRICATED, BOUNDARY]])
    expected = [False, False, False, True, True]
    assert open_x_faces(line)[0].tolist() == expected
    assert open_y_faces(line.T)[:, 0].tolist() == expected


def test_close_gaps_turns_every_gap_of_one_node_in_one_pass():
    """Gaps of two nodes stay, line ends stay, boundary nodes stay; a second pass finds nothing."""
    K, F, V, B = CONTACT, LUBRICATED, CAVITATED, BOUNDARY
    status = np.array([[F, K, F, K, V, K, F, F, K, F], [B, K, B, K, F, F, V, K, V, B]])
    assert close_gaps(status) == 2
    assert status.tolist() == [[F, K, K, K, K, K, F, F, K, F], [B, K, B, K, F, F, V, K, V, B]]
    assert close_gaps(status) == 0
    assert not enclosed(status).any()


def test_enclosed_leaves_the_status_alone():
    status = neighbourhood({"west", "east"})
    before = status.copy()
    assert np.argwhere(enclosed(status)).tolist() == [[1, 2]]
    assert (status == before).all()


def test_nodes_beside_contact_have_a_closed_face():
    """A contact node in the middle, and one in the line of a ghost: each with its four neighbours."""
    status = np.full((6, 5), LUBRICATED)
    status[2, 2] = status[0, 4] = CONTACT
    near = np.zeros((4, 5), bool)
    near[1, 1:4] = near[[0, 2], 2] = True
    near[0, 4] = True
    np.testing.assert_array_equal(beside_contact(status), near)


def test_largest_fluid_neighbour_of_hand_made_lines():
    """Contact never counts, boundary and cavitated nodes do, and line ends have three neighbours."""
    K, F, V, B = CONTACT, LUBRICATED, CAVITATED, BOUNDARY
    status = np.array([[B, F, K, B], [B, K, K, K], [B, V, K, F]])
    P = np.array([[0.0, 5.0, 9.0, 1.0], [2.0, 7.0, 8.0, 3.0], [0.0, 0.0, 9.0, 4.0]])
    result = largest_fluid_neighbour(P, status)
    assert result.tolist() == [[0.0, 5.0, -np.inf, 4.0]]
