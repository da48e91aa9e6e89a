from math import cos, pi, sqrt, tan

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import elliprd, elliprf

from mgehl.model.hertz import (
    edge_gap_coefficient,
    hertz_contact,
    hertz_gap,
    hertz_line_contact,
    hertz_line_gap,
)

E = 219.78e9

ellipses = pytest.mark.parametrize(
    "radius_x, radius_y",
    [(12.7e-3, 12.7e-3), (12.7e-3, 13e-3), (12.7e-3, 60e-3), (60e-3, 12.7e-3), (5e-3, 5.0)],
)


@ellipses
def test_curvatures_and_approach_follow_from_the_ellipse(radius_x, radius_y):
    """The displacement of an ellipse of Hertz pressure, in Carlson's integrals.

    u(x, y) = (p_h a b/E') int_0^inf (1 - x^2/(a^2 + t) - y^2/(b^2 + t)) dt/sqrt((a^2 + t)(b^2 + t) t)
    must be approach - x^2/2R_x - y^2/2R_y, with E' = 2 E*  [Johnson 1985, sec. 3.5].
    """
    contact = hertz_contact(800.0, radius_x, radius_y, E)
    a2, b2 = contact.a**2, contact.b**2
    factor = contact.p_h * contact.a * contact.b / E
    # int dt/((a^2 + t) sqrt(...)) = (2/3) R_D(0, b^2, a^2) and int dt/sqrt(...) = 2 R_F(0, a^2, b^2)
    assert factor * 2.0 / 3.0 * elliprd(0.0, b2, a2) == pytest.approx(0.5 / radius_x, rel=1e-9)
    assert factor * 2.0 / 3.0 * elliprd(0.0, a2, b2) == pytest.approx(0.5 / radius_y, rel=1e-9)
    assert factor * 2.0 * elliprf(0.0, a2, b2) == pytest.approx(contact.approach, rel=1e-9)


@pytest.mark.parametrize("exponent", range(2, 14))
def test_limit_to_the_circle(exponent):
    """Radii that differ by d give b/a = (R_y/R_x)^(2/3) and the circle's values, to first order in d."""
    d = 10.0**-exponent
    circle = hertz_contact(800.0, 12.7e-3, 12.7e-3, E)
    contact = hertz_contact(800.0, 12.7e-3, 12.7e-3 * (1.0 + d), E)
    # The elliptic integrals K - E cancel near the circle: half of the digits is what they leave.
    rounding = 1e-7
    for value, limit in ((contact.a, circle.a), (contact.b, circle.b), (contact.p_h, circle.p_h)):
        assert value == pytest.approx(limit, rel=d + rounding)
    assert contact.b / contact.a - 1.0 == pytest.approx(2.0 / 3.0 * d, abs=d**2 + rounding)


@ellipses
def test_edge_gap_of_an_ellipse(radius_x, radius_y):
    """The exact gap beside the edge on the x axis, s = x/a - 1, tends to C s^(3/2).

    h = (p_h a b/E') int_0^l (x^2/(a^2 + t) - 1) dt/sqrt((a^2 + t)(b^2 + t) t), l = x^2 - a^2; t = v^2.
    """
    contact = hertz_contact(800.0, radius_x, radius_y, E)
    ratio = contact.b / contact.a
    s = 1e-5 * min(1.0, ratio**2)

    def integrand(v):
        t = v * v
        return ((1 + s) ** 2 / (1 + t) - 1.0) * 2.0 / sqrt((1 + t) * (ratio**2 + t))

    integral = quad(integrand, 0.0, sqrt(s * (2 + s)), epsrel=1e-12)[0]
    gap = contact.p_h * contact.b / E * integral
    assert edge_gap_coefficient(contact, E) * s**1.5 == pytest.approx(gap, rel=1e-4)


@pytest.mark.parametrize("X", [0.0, 0.3, -0.9])
def test_approach_of_a_line_closes_the_parabola(X):
    """(1/pi) int P ln|X - t| dt + approach R/a^2 = X^2/2 inside, at every X."""
    R = 0.02
    contact = hertz_line_contact(1e5, R, E)
    # t = sin s takes the root at the ends out of the quadrature.
    integral = quad(lambda s: np.cos(s) ** 2 * np.log(abs(X - np.sin(s))), -pi / 2, pi / 2,
                    points=[np.arcsin(X)], epsabs=1e-12)[0]  # fmt: skip
    approach = contact.approach * R / contact.a**2
    assert approach == pytest.approx(0.25 + 0.5 * np.log(2.0), rel=1e-14)
    assert integral / pi + approach == pytest.approx(0.5 * X**2, abs=1e-9)


@ellipses
@pytest.mark.parametrize("X, Y", [(1.3, 0.0), (0.0, -1.3), (0.8, 0.9)])
def test_gap_of_an_ellipse(radius_x, radius_y, X, Y):
    """Undeformed gap, less the approach, and the deflection outside: that integral from the confocal
    ellipse outwards, where `hertz_gap` goes inwards [Johnson 1985, sec. 3.5]."""
    contact = hertz_contact(800.0, radius_x, radius_y, E)
    a, b, x, y = contact.a, contact.b, X * contact.a, Y * contact.b
    w = brentq(lambda w: x**2 / (a**2 + w) + y**2 / (b**2 + w) - 1.0, 0.0, 4.0 * (x**2 + y**2), xtol=1e-22)

    def integrand(v):  # w = a b tan^2 v
        t = sqrt(a * b) * tan(v)
        inside = 1.0 - x**2 / (a**2 + t**2) - y**2 / (b**2 + t**2)
        return inside / sqrt((a**2 + t**2) * (b**2 + t**2)) * sqrt(a * b) / cos(v) ** 2

    first = np.arctan(sqrt(w / (a * b)))
    deflection = contact.p_h * a * b * 2.0 / E * quad(integrand, first, pi / 2, epsrel=1e-11)[0]
    gap = x**2 / (2 * radius_x) + y**2 / (2 * radius_y) + deflection - contact.approach
    scale = contact.a**2 / radius_x
    found = hertz_gap(contact, E, np.array([x]), np.array([y]))[0]
    assert found / scale == pytest.approx(gap / scale, rel=1e-6, abs=1e-8)


def test_gap_of_a_line():
    """Tends to C s^(3/2) at the edge and to the parabola, less what the contact took, far away."""
    R = 0.02
    contact = hertz_line_contact(1e5, R, E)
    C = edge_gap_coefficient(contact, E) * R / contact.a**2
    X = np.array([-1.0 - 1e-4, 1.0 + 1e-4])
    np.testing.assert_allclose(hertz_line_gap(X), C * 1e-4**1.5, rtol=1e-4)
    assert (hertz_line_gap(np.array([-1.0, 0.0, 0.7])) == 0.0).all()
    # Its slope is that of the parabola less the line load's: d h/dX = sqrt(X^2 - 1).
    far = np.array([2.9999, 3.0001])
    assert np.diff(hertz_line_gap(far))[0] / 2e-4 == pytest.approx(sqrt(8.0), rel=1e-6)
