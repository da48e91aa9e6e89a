from math import exp, log

import numpy as np
import pytest

from mgehl.model.lubricant import DENSITY_LAWS, VISCOSITY_LAWS, ConstantViscosity, Roelands
from mgehl.model.oils import CELSIUS, OILS

P_H = 0.8e9
P = np.array([0.0, 0.25, 1.0, 1.7])


def central_difference(law, P, d=1e-6):
    return (law(P + d, P_H)[0] - law(P - d, P_H)[0]) / (2.0 * d)


def law_of(name, eta0):
    law = VISCOSITY_LAWS[name]
    return law(eta0) if law is ConstantViscosity else law(eta0, 18e-9)


LAWS = [law_of(name, 0.05).log_viscosity for name in VISCOSITY_LAWS]
LAWS += [oil.law(60.0 + CELSIUS).log_viscosity for oil in OILS.values()]


@pytest.mark.parametrize("law", [*LAWS, *(law().density for law in DENSITY_LAWS.values())])
def test_slopes_match_central_differences(law):
    slope = np.broadcast_to(law(P[1:], P_H)[1], P[1:].shape)
    np.testing.assert_allclose(slope, central_difference(law, P[1:]), rtol=1e-8)


@pytest.mark.parametrize("name", VISCOSITY_LAWS)
def test_viscosity_law_starts_at_eta0_with_slope_alpha(name):
    """ln(eta*) = 0 and d ln(eta*)/dp = alpha at p = 0, whatever eta0."""
    for eta0 in (1e-3, 0.096, 2.0):
        law = law_of(name, eta0)
        value, slope = law.log_viscosity(np.zeros(1), P_H)
        assert value[0] == 0.0
        assert np.ravel(slope)[0] == pytest.approx(law.pressure_viscosity * P_H, rel=1e-13)
        assert law.pressure_viscosity == (0.0 if name == "constant" else 18e-9)


def test_roelands_at_a_known_pressure():
    """p = 1/5.1e-9 Pa doubles the bracket: ln(eta*) = (ln eta0 + 9.67)(2^z - 1)."""
    law = Roelands(0.04, 20e-9)
    S = log(0.04) + 9.67
    z = 20e-9 / (5.1e-9 * S)
    assert z == pytest.approx(0.6079, abs=1e-4)
    value, slope = law.log_viscosity(np.array([1.0]), 1.0 / 5.1e-9)
    assert value[0] == pytest.approx(S * (2.0**z - 1.0), rel=1e-14)
    assert slope[0] == pytest.approx(S * z * 2.0 ** (z - 1.0), rel=1e-14)


def test_roelands_takes_tension_as_ambient_pressure():
    """A Newton step may overshoot below p = 0, where the power has no value."""
    value, slope = Roelands(0.04, 20e-9).log_viscosity(np.array([-5.0, -1e-3]), P_H)
    assert value.tolist() == [0.0, 0.0]
    assert np.isfinite(slope).all()


@pytest.mark.parametrize("viscosity", [exp(-9.67), 6e-5, 1e-9])
def test_roelands_refuses_a_viscosity_without_meaning(viscosity):
    with pytest.raises(ValueError, match="above 6.3e-5 Pa s"):
        Roelands(viscosity, 20e-9)
