"""What drags bodies that roll beyond the domain."""

from math import log, pi

import pytest
from tools.contacts import moes

from mgehl.config import config_from_tables
from mgehl.kinds import contact_from
from mgehl.model.drag import kapitza_drag_beyond, kapitza_factor
from mgehl.studies.study import merged


def contact(M=3.0, L=2.0, angle=0.0, **bodies):
    return contact_from(config_from_tables(merged(moes(M, L, **bodies), {"motion": {"angle": angle}})))


def test_drag_beyond_grows_with_the_logarithm_of_the_domain():
    """Of a ball half of the integral of h dp/dx between two squares, one twice as wide: pi K R ln 2."""
    ball = contact()
    square = (-8.0, 8.0)
    twice = (-16.0, 16.0)
    between = kapitza_drag_beyond(ball, square, square) - kapitza_drag_beyond(ball, twice, twice)
    K = kapitza_factor(ball.lubricant, ball.speed, ball.radius_x, ball.radius_x)
    assert between == pytest.approx(pi * K * ball.radius_x * log(2.0), rel=1e-5)
