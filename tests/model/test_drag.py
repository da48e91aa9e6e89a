"""What drags bodies that roll beyond the domain."""

from math import log, pi

import pytest
from tools.contacts import moes

from mgehl.config import config_from_tables
from mgehl.kinds import contact_from
from mgehl.model.drag import kapitza_drag_beyond, kapitza_factor
from mgehl.studies.study import merged

ELLIPSE = {"radius_x": 10e-3, "radius_y": 40e-3}


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


def test_drag_beyond_follows_the_motion():
    """Turned by 90 degrees with its ellipse the body is dragged by as much."""
    along, across = contact(**ELLIPSE), contact(angle=90.0, radius_x=40e-3, radius_y=10e-3)
    turned = kapitza_drag_beyond(across, (-9.0, 9.0), (-14.0, 3.0))
    assert turned == pytest.approx(kapitza_drag_beyond(along, (-14.0, 3.0), (-9.0, 9.0)), rel=1e-9)
