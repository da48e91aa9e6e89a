from math import log, pi, sqrt

import pytest

from mgehl.model.line import LineContact
from mgehl.model.lubricant import Barus, DowsonHigginson, Lubricant

LUBRICANT = Lubricant(Barus(0.096, 18.2e-9), DowsonHigginson())
CONTACT = LineContact(1.86e6, 12.7e-3, 219.78e9, 0.5, LUBRICANT)


def test_approach_and_deflection_are_those_of_the_kernel():
    """1/4 + ln2/2 by a deflection of 1/pi times the integral of -P ln|X|."""
    assert CONTACT.approach == pytest.approx(0.25 + 0.5 * log(2.0), rel=1e-14)
    assert CONTACT.deflection_scale == pytest.approx(1.0 / pi, rel=1e-14)


def test_reynolds_coefficient_and_alpha_bar_in_moes_numbers():
    """lambda = 3 pi^2/(8 M^2) and alpha_bar = L sqrt(M/(2 pi)).

    lambda = 12 u eta0 R^2/(a^3 p_h) with a^3 p_h = (2/pi) w a^2 = 16 w^2 R/(pi^2 E') is
    (3 pi^2/4) U/W^2, and U/W^2 = 1/(2 M^2); p_h/E' = sqrt(W/(2 pi)).
    """
    groups = CONTACT.groups
    assert CONTACT.lambda_ == pytest.approx(3.0 * pi**2 / (8.0 * groups.M**2), rel=1e-13)
    alpha_bar = LUBRICANT.pressure_viscosity * CONTACT.pressure_scale
    assert alpha_bar == pytest.approx(groups.L * sqrt(groups.M / (2.0 * pi)), rel=1e-13)
