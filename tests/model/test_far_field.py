"""Kapitza's pressure far outside, and the load that it carries beyond a domain."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from tools.contacts import moes

from mgehl.config import config_from_tables
from mgehl.kinds import contact_from
from mgehl.model.far_field import (
    kapitza_drag_beyond,
    kapitza_factor,
    kapitza_load_beyond,
)
from mgehl.model.frame import Frame
from mgehl.studies.study import merged

X, Y = (-20.0, 2.0), (-12.0, 12.0)
ELLIPSE = {"radius_x": 10e-3, "radius_y": 40e-3}


def contact(M=3.0, L=2.0, angle=0.0, **bodies):
    return contact_from(config_from_tables(merged(moes(M, L, **bodies), {"motion": {"angle": angle}})))


def kapitza_pressure(ball, x, y):
    """By the formula as it is printed, x and y in m."""
    h = ball.flooded_film + x**2 / (2.0 * ball.radius_x) + y**2 / (2.0 * ball.radius_y)
    radii = ball.radius_x, ball.radius_y
    K_x = kapitza_factor(ball.lubricant, ball.speed * ball.motion[0], *radii)
    K_y = kapitza_factor(ball.lubricant, ball.speed * ball.motion[1], *radii[::-1])
    return -(K_x * x + K_y * y) / h**2, h


@pytest.mark.parametrize("angle", [0.0, 30.0])
def test_kapitza_s_pressure_solves_reynolds_equation(angle):
    """div(h^3 grad p) = 12 eta u . grad h by central differences, at some places."""
    ball = contact(angle=angle, **ELLIPSE)
    step = 1e-3 * ball.x_scale
    shifts = step * np.array([-0.5, 0.5])

    def flux(x, y, along):
        dx, dy = (0.5 * step, 0.0) if along == 0 else (0.0, 0.5 * step)
        ahead, behind = kapitza_pressure(ball, x + dx, y + dy)[0], kapitza_pressure(ball, x - dx, y - dy)[0]
        return kapitza_pressure(ball, x, y)[1] ** 3 * (ahead - behind) / step

    for x, y in ball.x_scale * np.array([(-20.0, 3.0), (-5.0, 15.0), (4.0, -8.0)]):
        by_x, by_y = (flux(x + s, y, 0) for s in shifts), (flux(x, y + s, 1) for s in shifts)
        div = sum(np.subtract(*pair) for pair in (tuple(by_x), tuple(by_y))) / -step
        u, v = (ball.speed * part for part in ball.motion)
        wedge = 12.0 * ball.lubricant.viscosity * (u * x / ball.radius_x + v * y / ball.radius_y)
        assert div == pytest.approx(wedge, rel=1e-5)


@pytest.mark.parametrize("angle", [90, 135, 200, 315])
def test_it_is_the_same_in_the_axes_of_the_solver(angle):
    ball = contact(angle=angle, **ELLIPSE)
    frame = Frame.of(angle)[0]
    there = kapitza_load_beyond(ball.in_frame(frame), *frame.intervals(X, Y))
    assert there == pytest.approx(kapitza_load_beyond(ball, X, Y), rel=1e-9)


@pytest.mark.parametrize("M, counted", [(3.0, 1.0), (8.0, 1.0), (16.0, 0.0), (200.0, 0.0)])
def test_the_load_beyond_is_counted_where_the_film_answers_to_it(M, counted):
    assert contact(M, 5.0).counted_beyond == counted
    for said in (True, False):
        assert replace(contact(M, 5.0), load_beyond=said).counted_beyond == said


def test_drag_beyond_grows_with_the_logarithm_of_the_domain():
    """Of a ball half of the integral of h dp/dx between two squares, one twice as wide: pi K R ln 2."""
    ball = contact()
    square = (-8.0, 8.0)
    twice = (-16.0, 16.0)
    between = kapitza_drag_beyond(ball, square, square) - kapitza_drag_beyond(ball, twice, twice)
    K = kapitza_factor(ball.lubricant, ball.speed, ball.radius_x, ball.radius_x)
    assert between == pytest.approx(pi * K * ball.radius_x * np.log(2.0), rel=1e-5)


def test_drag_beyond_follows_the_motion():
    """Turned by 90 degrees with its ellipse the body is dragged by as much."""
    along, across = contact(**ELLIPSE), contact(angle=90.0, radius_x=40e-3, radius_y=10e-3)
    turned = kapitza_drag_beyond(across, (-9.0, 9.0), (-14.0, 3.0))
    assert turned == pytest.approx(kapitza_drag_beyond(along, (-14.0, 3.0), (-9.0, 9.0)), rel=1e-9)
