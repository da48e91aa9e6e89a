"""Dry Hertz contact on a flat: of a paraboloid, circular or elliptical, and of a cylinder."""

from dataclasses import dataclass
from math import log, pi, sqrt

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

GAP_POINTS = 24
"""Points of the Gauss quadrature of `hertz_gap`."""


@dataclass(frozen=True)
class HertzContact:
    """Semi-axes (m), maximum pressure (Pa) and approach (m) of a dry contact."""

    a: float
    """Semi-axis along x, the direction of motion."""
    b: float
    """Semi-axis along y; of a line contact a metre of its length."""
    p_h: float
    approach: float


def hertz_contact(load, radius_x, radius_y, reduced_modulus):
    """Solve the dry contact [Johnson 1985, eqs. 4.25-4.28]. `load` in N, radii in m, `reduced_modulus` E'
    in Pa with E' = 2 E*, as in the paper."""
    E_star = reduced_modulus / 2.0
    small, large = sorted((radius_x, radius_y))
    ratio = _axis_ratio(large / small)
    m = 1.0 - ratio**2
    curvature = 0.5 / radius_x + 0.5 / radius_y
    major = (3.0 * load * ellipe(m) / (2.0 * pi * E_star * curvature * ratio**2)) ** (1.0 / 3.0)
    minor = ratio * major
    p_h = 3.0 * load / (2.0 * pi * major * minor)
    approach = p_h / E_star * minor * ellipk(m)
    a, b = (minor, major) if radius_x <= radius_y else (major, minor)
    return HertzContact(a, b, p_h, approach)


def hertz_line_contact(load, radius, reduced_modulus):
    """The dry line contact under `load` N/m [Johnson 1985, eqs. 4.43-4.45].

    The approach of a line contact has no absolute value: here it belongs to a deflection that
    counts -ln|x/a|, with which the parabola's gap closes at 1/4 + ln(2)/2 units of a^2/R.
    """
    a = sqrt(8.0 * load * radius / (pi * reduced_modulus))
    return HertzContact(a, 1.0, 2.0 * load / (pi * a), (0.25 + 0.5 * log(2.0)) * a**2 / radius)


def _axis_ratio(radius_ratio):
    """Minor over major semi-axis for a ratio R_large/R_small >= 1."""
    if radius_ratio < 1.0 + 1e-6:
        # K - E cancels near the circle; there the axes differ by two thirds of the radii.
        return radius_ratio ** (-2.0 / 3.0)

    def mismatch(ratio):
        m = 1.0 - ratio**2
        return (ellipe(m) / ratio**2 - ellipk(m)) / (ellipk(m) - ellipe(m)) - radius_ratio

    return brentq(mismatch, 1e-6, 1.0 - 1e-9, xtol=1e-15)


def hertz_pressure(X, Y):
    """Dimensionless pressure sqrt(1 - X^2 - Y^2), zero outside; X = x/a, Y = y/b."""
    return np.sqrt(np.maximum(1.0 - X**2 - Y**2, 0.0))


def hertz_gap(contact, reduced_modulus, x, y):
    """Gap (m) of the dry contact at x and y (m, arrays of one shape); zero inside the ellipse.

    Outside it is p_h a b/E* times the integral over t, from 0 to the confocal ellipse through the point, of
    (x^2/(a^2 + t^2) + y^2/(b^2 + t^2) - 1)/((a^2 + t^2)(b^2 + t^2))^(1/2) [Johnson 1985, sec. 3.5].
    """
    a, b = contact.a, contact.b
    minor, major = sorted((a, b))
    beyond = x**2 + y**2 - a**2 - b**2
    ellipse = x**2 * b**2 + y**2 * a**2 - a**2 * b**2
    w = np.where(ellipse > 0.0, 0.5 * (beyond + np.sqrt(beyond**2 + 4.0 * np.maximum(ellipse, 0.0))), 0.0)
    last = np.arcsinh(np.sqrt(w) / minor)[..., None]
    nodes, weights = np.polynomial.legendre.leggauss(GAP_POINTS)
    t2 = (minor * np.sinh(0.5 * last * (nodes + 1.0))) ** 2
    inside = x[..., None] ** 2 / (a**2 + t2) + y[..., None] ** 2 / (b**2 + t2) - 1.0
    integral = 0.5 * last[..., 0] * (inside / np.sqrt(major**2 + t2) @ weights)
    return contact.p_h * a * b * 2.0 / reduced_modulus * integral


def hertz_line_gap(X):
    """Gap of the dry line contact at X = x/a in units of a^2/R; zero inside [Johnson 1985, sec. 4.2]."""
    distance = np.maximum(np.abs(X), 1.0)
    return 0.5 * (distance * np.sqrt(distance**2 - 1.0) - np.arccosh(distance))


def edge_gap_coefficient(contact, reduced_modulus):
    """C in metres of the dry gap h = C s^(3/2) beside the edge on the x axis, s = x/a - 1. Locally plane
    strain: C = (8 sqrt2/3) p_h a/E', which is (8 sqrt2/(3 pi)) a^2/R for a circle."""
    return 8.0 * sqrt(2.0) / 3.0 * contact.p_h * contact.a / reduced_modulus
