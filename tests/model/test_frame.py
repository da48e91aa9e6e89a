from math import cos, radians, sin

import numpy as np
import pytest

from mgehl.model.frame import Frame

DIRECTIONS = range(-360, 361, 5)

FRAMES = [
    Frame(mirrored_x, mirrored_y, exchanged)
    for mirrored_x in (False, True)
    for mirrored_y in (False, True)
    for exchanged in (False, True)
]
EACH = pytest.mark.parametrize("frame", FRAMES, ids=str)

NX, NY = 5, 3
X, Y = np.linspace(-2.0, 1.0, NX), np.linspace(-1.0, 3.0, NY)
"""Nodes of the user's, with no symmetry."""


def values(x, y):
    """Of no symmetry either, and no two nodes alike."""
    return 1000.0 * x + y


def of_user():
    return values(X[None, :], Y[:, None])


@pytest.mark.parametrize("angle", DIRECTIONS)
def test_in_its_frame_every_motion_goes_towards_X_and_no_more_towards_Y(angle):
    frame, acute = Frame.of(angle)
    assert 0.0 <= acute <= 45.0
    there = cos(radians(acute)), sin(radians(acute))
    assert frame.users_point(*there) == pytest.approx((cos(radians(angle)), sin(radians(angle))), abs=1e-15)


@EACH
class TestEveryFrame:
    def test_arrays_come_back(self, frame):
        np.testing.assert_array_equal(frame.users_array(frame.array(of_user())), of_user())

    def test_an_array_there_has_the_values_of_the_users_points(self, frame):
        """The nodes are those of the intervals, each at the user's point it says it is."""
        x, y = frame.intervals((X[0], X[-1]), (Y[0], Y[-1]))
        nx, ny = frame.pair(NX, NY)
        there = np.meshgrid(np.linspace(*x, nx), np.linspace(*y, ny))
        np.testing.assert_allclose(frame.array(of_user()), values(*frame.users_point(*there)), rtol=1e-14)

    def test_ranges_of_nodes_are_the_users(self, frame):
        """Nodes marked on one of the user's lines along each axis are found again."""
        marked = np.zeros((NY, NX), bool)
        marked[1, 1:3], marked[0:2, 1] = True, True
        there = frame.array(marked)
        ny, nx = there.shape
        along = [_ends(there.any(axis=axis)) for axis in (0, 1)]
        assert frame.users_ranges(*along, nx, ny) == ((2, 3), (1, 2))

    def test_sides_of_a_node_are_the_users(self, frame):
        """West, east, before, after: the values beside the middle node."""
        there = frame.array(of_user())
        j, i = (n // 2 for n in there.shape)
        sides = there[j, i - 1], there[j, i + 1], there[j - 1, i], there[j + 1, i]
        j, i = NY // 2, NX // 2
        mine = of_user()
        assert frame.users_sides(*sides) == (mine[j, i - 1], mine[j, i + 1], mine[j - 1, i], mine[j + 1, i])


def _ends(marked):
    """First and last, from 1."""
    nodes = np.flatnonzero(marked) + 1
    return int(nodes[0]), int(nodes[-1])
