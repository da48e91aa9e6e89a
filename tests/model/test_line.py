from math import log, pi, sqrt

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


def test_load_is_the_integral_of_the_hertz_pressure(contact):
    assert contact.load_integral == pi / 2.0
    newtons = contact.load_integral * contact.x_scale * contact.pressure_scale
    assert newtons == pytest.approx(LOAD, rel=1e-14)
    assert contact.contact_area == 2.0


def test_reynolds_coefficient_and_alpha_bar_in_moes_numbers(contact):
    """lambda = 3 pi^2/(8 M^2) and alpha_bar = L sqrt(M/(2 pi)).

    lambda = 12 u eta0 R^2/(a^3 p_h) with a^3 p_h = (2/pi) w a^2 = 16 w^2 R/(pi^2 E') is
    (3 pi^2/4) U/W^2, and U/W^2 = 1/(2 M^2); p_h/E' = sqrt(W/(2 pi)).
    """
    groups = contact.groups
    assert contact.lambda_ == pytest.approx(3.0 * pi**2 / (8.0 * groups.M**2), rel=1e-13)
    alpha_bar = LUBRICANT.pressure_viscosity * contact.pressure_scale
    assert alpha_bar == pytest.approx(groups.L * sqrt(groups.M / (2.0 * pi)), rel=1e-13)
