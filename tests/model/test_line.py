from math import log, pi, sqrt

import numpy as np
import pytest

from mgehl.model.hertz import hertz_line_contact
from mgehl.model.line import LineContact
from mgehl.model.lubricant import Barus, DowsonHigginson, Lubricant

LUBRICANT = Lubricant(Barus(0.096, 18.2e-9), DowsonHigginson())
LOAD, RADIUS, MODULUS, SPEED = 1.86e6, 12.7e-3, 219.78e9, 0.5


@pytest.fixture
def contact():
    return LineContact(LOAD, RADIUS, MODULUS, SPEED, LUBRICANT)


def test_scales(contact):
    """A metre of length along Y; the approach is 1/4 + ln2/2 and the deflection factor 1/pi."""
    assert contact.hertz == hertz_line_contact(LOAD, RADIUS, MODULUS)
    assert (contact.y_scale, contact.k_e) == (1.0, 1.0)
    assert contact.approach == pytest.approx(0.25 + 0.5 * log(2.0), rel=1e-14)
    assert contact.deflection_scale == pytest.approx(1.0 / pi, rel=1e-14)


@pytest.mark.parametrize("load, radius, modulus", [(1e4, 0.1, 70e9), (5e6, 1e-3, 210e9)])
def test_deflection_factor_is_that_of_every_line(load, radius, modulus):
    """-(4/(pi E')) int p ln|x - x'| dx' in units of a^2/R, with x/a and p/p_h."""
    contact = LineContact(load, radius, modulus, SPEED, LUBRICANT)
    metres = 4.0 / (pi * modulus) * contact.hertz.p_h * contact.hertz.a
    assert contact.deflection_scale * contact.film_scale == pytest.approx(metres, rel=1e-14)
    assert contact.deflection_scale == pytest.approx(1.0 / pi, rel=1e-14)


def test_load_is_the_integral_of_the_hertz_pressure(contact):
    assert contact.load_integral == pi / 2.0
    newtons = contact.load_integral * contact.x_scale * contact.pressure_scale
    assert newtons == pytest.approx(LOAD, rel=1e-14)
    assert contact.contact_area == 2.0


def test_undeformed_gap_is_the_parabola(contact):
    """x^2/2R in metres, the same on every line."""
    metres = (0.5 * contact.hertz.a) ** 2 / (2.0 * RADIUS)
    assert contact.undeformed_gap(0.5, 7.0) * contact.film_scale == pytest.approx(metres, rel=1e-14)
    assert contact.undeformed_gap(np.zeros((1, 5)), np.zeros((1, 1))).shape == (1, 5)


def test_groups(contact):
    """U = eta0 u/(E' R), W = w/(E' R), G = alpha E', M = W (2U)^(-1/2), L = G (2U)^(1/4)."""
    groups = contact.groups
    U, W = 0.096 * 0.5 / (219.78e9 * 12.7e-3), 1.86e6 / (219.78e9 * 12.7e-3)
    assert (groups.U, groups.W) == pytest.approx((U, W), rel=1e-14)
    assert groups.G == pytest.approx(18.2e-9 * 219.78e9, rel=1e-14)
    assert groups.M == pytest.approx(W / sqrt(2.0 * U), rel=1e-14)
    assert groups.L == pytest.approx(groups.G * sqrt(sqrt(2.0 * U)), rel=1e-14)


def test_reynolds_coefficient_and_alpha_bar_in_moes_numbers(contact):
    """lambda = 3 pi^2/(8 M^2) and alpha_bar = L sqrt(M/(2 pi)).

    lambda = 12 u eta0 R^2/(a^3 p_h) with a^3 p_h = (2/pi) w a^2 = 16 w^2 R/(pi^2 E') is
    (3 pi^2/4) U/W^2, and U/W^2 = 1/(2 M^2); p_h/E' = sqrt(W/(2 pi)).
    """
    groups = contact.groups
    assert contact.lambda_ == pytest.approx(3.0 * pi**2 / (8.0 * groups.M**2), rel=1e-13)
    alpha_bar = LUBRICANT.pressure_viscosity * contact.pressure_scale
    assert alpha_bar == pytest.approx(groups.L * sqrt(groups.M / (2.0 * pi)), rel=1e-13)


def test_formulas_as_printed(contact):
    """3.06 U^.69 G^.56 W^-.10, 2.65 U^.70 G^.54 W^-.13 times R; minimum below central."""
    U, W, G = contact.groups.U, contact.groups.W, contact.groups.G
    formulas = contact.formulas
    assert formulas.dowson_higginson_central == pytest.approx(
        3.06 * U**0.69 * G**0.56 * W**-0.10 * RADIUS, rel=1e-14
    )
    assert formulas.dowson_higginson_minimum == pytest.approx(
        2.65 * U**0.70 * G**0.54 * W**-0.13 * RADIUS, rel=1e-14
    )
    assert formulas.dowson_higginson_minimum < formulas.dowson_higginson_central == contact.expected_film


def test_inlet_length_and_grubin_film(contact):
    """C = (2 sqrt2/3) a^2/R; h = (12*0.2687 alpha eta0 u a)^(3/4)/sqrt(C); s* = (h/C)^(2/3)."""
    a = contact.hertz.a
    C = 2.0 * sqrt(2.0) / 3.0 * a**2 / RADIUS
    h = (12.0 * 0.2687 * 18.2e-9 * 0.096 * SPEED * a) ** 0.75 / sqrt(C)
    assert contact.formulas.grubin == pytest.approx(h, rel=1e-13)
    assert contact.inlet_length == pytest.approx((h / C) ** (2.0 / 3.0), rel=1e-13)
