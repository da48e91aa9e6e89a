from math import log, pi

import pytest
from contacts import contact_of, moes

from mgehl.model.drag import kapitza_drag_beyond, kapitza_factor


def test_drag_beyond_grows_with_the_logarithm_of_the_domain():
    """Of a ball half of the integral of h dp/dx between two squares, one twice as wide: pi K R ln 2."""
    ball = contact_of(moes(3.0, 2.0))
    square = (-8.0, 8.0)
    twice = (-16.0, 16.0)
    between = kapitza_drag_beyond(ball, square, square) - kapitza_drag_beyond(ball, twice, twice)
    K = kapitza_factor(ball.lubricant, ball.speed, ball.radius_x, ball.radius_x)
    assert between == pytest.approx(pi * K * ball.radius_x * log(2.0), rel=1e-5)
