from math import pi, sqrt

import numpy as np
import pytest
from scipy.integrate import dblquad

from mgehl.model.hertz import hertz_contact, hertz_pressure
from mgehl.model.lubricant import Barus, ConstantDensity, DowsonHigginson, Lubricant
from mgehl.model.point import LOAD, PointContact

LUBRICANT = Lubricant(Barus(0.096, 18.2e-9), DowsonHigginson())


def headline(speed=7.5e-3):
    return PointContact(800.0, 12.7e-3, 12.7e-3, 219.78e9, speed, LUBRICANT)


def elliptical(radius_x=12.7e-3, radius_y=40e-3):
    return PointContact(800.0, radius_x, radius_y, 219.78e9, 0.1, LUBRICANT)


def test_load_is_the_integral_of_the_hertz_pressure():
    """Liu eq. 50: also in ellipses, since Y is y/b."""
    disc = dblquad(lambda t, r: r * hertz_pressure(r, 0.0), 0.0, 1.0, 0.0, 2.0 * pi)[0]
    assert LOAD == pytest.approx(disc, rel=1e-9)


def test_headline_groups():
    """U = eta0 u/(E' R), W = w/(E' R^2), G = alpha E', by hand."""
    groups = headline().groups
    assert groups.U == pytest.approx(2.5795e-13, rel=1e-4)
    assert groups.W == pytest.approx(2.2568e-5, rel=1e-4)
    assert groups.G == pytest.approx(4000.0, rel=1e-4)
    assert groups.M == pytest.approx(groups.W / (2.0 * groups.U) ** 0.75, rel=1e-13)
    assert groups.L == pytest.approx(groups.G * (2.0 * groups.U) ** 0.25, rel=1e-13)


@pytest.mark.parametrize("M, L", [(20.0, 10.0), (200.0, 10.0), (1e4, 2.5)])
@pytest.mark.parametrize("radius_y", [12.7e-3, 40e-3])
def test_moes_round_trip(M, L, radius_y):
    contact = PointContact.from_moes(M, L, 12.7e-3, radius_y, 219.78e9, LUBRICANT)
    assert contact.groups.M == pytest.approx(M, rel=1e-12)
    assert contact.groups.L == pytest.approx(L, rel=1e-12)


@pytest.mark.parametrize("M, L", [(20.0, 10.0), (200.0, 10.0), (1e4, 2.5)])
def test_reynolds_coefficient_and_alpha_bar_of_a_circle(M, L):
    """1/lambda = 1/[pi (128/(3 M^4))^(1/3)] and alpha_bar = (L/pi)(1.5 M)^(1/3)."""
    lubricant = Lubricant(Barus(0.02, 25e-9), ConstantDensity())
    contact = PointContact.from_moes(M, L, 0.01, 0.01, 200e9, lubricant)
    assert contact.lambda_ == pytest.approx(pi * (128.0 / (3.0 * M**4)) ** (1.0 / 3.0), rel=1e-12)
    alpha_bar = contact.lubricant.pressure_viscosity * contact.hertz.p_h
    assert alpha_bar == pytest.approx(L / pi * (1.5 * M) ** (1.0 / 3.0), rel=1e-12)


@pytest.mark.parametrize("M", [20.0, 200.0])
def test_film_in_moes_units(M):
    """H_Moes = H sqrt(6 pi/lambda) for a circle, the scaling of the reference films."""
    contact = PointContact.from_moes(M, 10.0, 0.01, 0.01, 200e9, LUBRICANT)
    per_H = contact.film_scale * contact.moes_scale
    assert per_H == pytest.approx(sqrt(6.0 * pi / contact.lambda_), rel=1e-12)


def test_scales_of_a_circle():
    """H in units of a^2/R, approach 1, k_e 1, and the deflection factor 2/pi^2 of Eq. 49."""
    contact = headline()
    assert contact.film_scale == pytest.approx(contact.hertz.a**2 / 12.7e-3, rel=1e-15)
    assert contact.k_e == 1.0
    assert contact.approach == pytest.approx(1.0, rel=1e-13)
    assert contact.deflection_scale == pytest.approx(2.0 / pi**2, rel=1e-13)


@pytest.mark.parametrize("radii", [(12.7e-3, 40e-3), (40e-3, 12.7e-3)])
def test_undeformed_gap_is_the_paraboloid(radii):
    """x^2/2R_x + y^2/2R_y in metres at x = 0.5 a, y = -2 b."""
    contact = elliptical(*radii)
    x, y = 0.5 * contact.hertz.a, -2.0 * contact.hertz.b
    metres = x**2 / (2.0 * radii[0]) + y**2 / (2.0 * radii[1])
    gap = contact.undeformed_gap(0.5, -2.0) * contact.film_scale
    assert gap == pytest.approx(metres, rel=1e-13)
    assert contact.undeformed_gap(np.zeros(3), np.array([0.0, 1.0, 2.0])).shape == (3,)


@pytest.mark.parametrize("radii", [(12.7e-3, 12.7e-3), (12.7e-3, 40e-3), (40e-3, 12.7e-3)])
def test_dry_contact_closes_in_dimensionless_units(radii):
    """At the centre -approach + deflection_scale iint P/r = 0 for the Hertz pressure.

    With x = a r cos t, y = b r sin t the integral of P/r over dx dy/a^2 is
    (pi/4) (1/k_e) int_0^2pi dt/sqrt(cos^2 t + sin^2 t/k_e^2), as int_0^1 sqrt(1 - r^2) dr = pi/4.
    """
    contact = elliptical(*radii)
    t = np.arange(4096) * 2.0 * pi / 4096
    mean = (1.0 / np.sqrt(np.cos(t) ** 2 + (np.sin(t) / contact.k_e) ** 2)).mean()
    integral = pi / 4.0 / contact.k_e * 2.0 * pi * mean
    assert contact.deflection_scale * integral == pytest.approx(contact.approach, rel=1e-9)


def test_hertz_is_that_of_the_same_bodies():
    contact = elliptical()
    assert contact.hertz == hertz_contact(800.0, 12.7e-3, 40e-3, 219.78e9)
    assert contact.k_e == contact.hertz.a / contact.hertz.b < 1.0


def test_formulas_in_metres():
    """All four of the headline case agree within a factor of two, minimum below central."""
    formulas = headline().formulas
    central = formulas.hamrock_dowson_central
    assert formulas.hamrock_dowson_minimum < central
    for film in (formulas.nijenbanning_venner_moes, formulas.grubin):
        assert 0.5 * central < film < 2.0 * central


def test_hamrock_dowson_gets_b_over_a():
    """The ellipticity is k = b/a, above one where the contact is long across the motion."""
    contact = elliptical(12.7e-3, 40e-3)
    U, W, G = contact.groups.U, contact.groups.W, contact.groups.G
    k = contact.hertz.b / contact.hertz.a
    assert k > 1.0
    expected = 2.69 * U**0.67 * G**0.53 * W**-0.067 * (1.0 - 0.61 * np.exp(-0.73 * k)) * 12.7e-3
    assert contact.formulas.hamrock_dowson_central == pytest.approx(expected, rel=1e-13)


def test_inlet_length_of_the_headline_case():
    """s* = (h/C)^(2/3) with the Ertel-Grubin h and C = 1.2004 a^2/R."""
    contact = headline()
    a = contact.hertz.a
    C = 8.0 * sqrt(2.0) / (3.0 * pi) * a**2 / 12.7e-3
    h = (12.0 * 0.2687 * 18.2e-9 * 0.096 * 7.5e-3 * a) ** 0.75 / sqrt(C)
    assert contact.formulas.grubin == pytest.approx(h, rel=1e-12)
    assert contact.inlet_length == pytest.approx((h / C) ** (2.0 / 3.0), rel=1e-12)
