from itertools import product
from math import cos, radians, sin

import numpy as np
import pytest

from mgehl.model.frame import Frame, direction

DIRECTIONS = range(-360, 361, 5)

FRAMES = [Frame(*each) for each in product((False, True), repeat=3)]
"""Mirrored along x, along y, exchanged, or not."""

NX, NY = 5, 3
X, Y = np.linspace(-2.0, 1.0, NX), np.linspace(-1.0, 3.0, NY)
"""Nodes of the user's, with no symmetry."""


def values(x, y):
    return 1000.0 * x + y


@pytest.mark.parametrize("angle", DIRECTIONS)
def test_in_its_frame_every_motion_goes_towards_X_and_no_more_towards_Y(angle):
    frame, acute = Frame.of(angle)
    assert 0.0 <= acute <= 45.0
    there = cos(radians(acute)), sin(radians(acute))
    assert frame.users_point(*there) == pytest.approx((cos(radians(angle)), sin(radians(angle))), abs=1e-15)


@pytest.mark.parametrize("angle", [*DIRECTIONS, 33.7, 301.3, -123.4])
def test_an_angle_there_is_that_of_the_vector(angle):
    """To the last bit of the motion that a frame is made for."""
    made, acute = Frame.of(angle)
    assert made.angle(angle) == acute
    for frame in FRAMES:
        assert direction(frame.angle(angle)) == pytest.approx(frame.vector(*direction(angle)), abs=1e-15)


@pytest.mark.parametrize("frame", FRAMES, ids=str)
def test_an_array_there_has_the_values_of_the_users_points(frame):
    """The nodes are those of the intervals, each at the user's point it says it is."""
    x, y = frame.intervals((X[0], X[-1]), (Y[0], Y[-1]))
    nx, ny = frame.pair(NX, NY)
    there = np.meshgrid(np.linspace(*x, nx), np.linspace(*y, ny))
    of_user = values(X[None, :], Y[:, None])
    np.testing.assert_allclose(frame.array(of_user), values(*frame.users_point(*there)), rtol=1e-14)
