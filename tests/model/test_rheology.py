import numpy as np
import pytest

from mgehl.model.conditions import Conditions
from mgehl.model.own_function import OwnFunction, OwnFunctionError
from mgehl.model.own_laws import OwnRheology
from mgehl.model.rheology import Eyring, Limiting, Newtonian, effective_mobilities

P = np.array([0.0, 0.5e9, 1e9])


def at(rate, eta=2.0):
    return Conditions(P, np.full(3, eta), shear_rate=np.full(3, rate))


def test_eyring_is_newtonian_where_it_is_hardly_sheared_and_logarithmic_where_it_is_sheared_much():
    law = Eyring(5e6)
    np.testing.assert_allclose(law.shear_stress(at(1.0)), Newtonian().shear_stress(at(1.0)), rtol=1e-12)
    np.testing.assert_allclose(law.shear_stress(at(1e12)), 5e6 * np.log(2.0 * 2e12 / 5e6), rtol=1e-10)


def test_a_limit_is_a_part_of_the_pressure():
    law = Limiting(0.05, Eyring(5e6))
    assert law.shear_stress(at(1e12)).tolist() == [0.0, 0.05 * 0.5e9, 0.05 * 1e9]
    assert law.shear_stress(at(1.0))[1:].tolist() == Eyring(5e6).shear_stress(at(1.0))[1:].tolist()


def test_effective_mobilities_are_those_of_a_film_sheared_by_a_small_pressure_gradient():
    """Flow by dp/dx and by dp/dy through a film in which sliding makes a stress of tau, over the Newtonian
    h^3/(12 eta): by quadrature of the shear rates, in units where h, eta and tau_0 are 1."""
    (z, weights), tau, small = np.polynomial.legendre.leggauss(20), 1.7, 1e-4
    z, weights = 0.5 * z, 0.5 * weights
    x, y = tau + np.outer([1.0, 0.0], small * z), np.outer([0.0, 1.0], small * z)
    size = np.hypot(x, y)
    rates = np.sinh(size) * np.array([x[0], y[1]]) / size
    flows = 12.0 * (rates * z * weights).sum(axis=1) / small
    found = effective_mobilities(np.array(np.sinh(tau)))
    np.testing.assert_allclose([each[0] for each in found], flows, rtol=1e-6)


def test_slopes_of_effective_mobilities_are_those_of_their_values():
    sigma = np.array([1e-2, 9e-4, 1.1e-3, 0.1, 3.0, 1e4])
    step = 1e-3 * sigma
    for number in (0, 1):
        above, below = (effective_mobilities(sigma + sign * step)[number][0] for sign in (1.0, -1.0))
        slopes = effective_mobilities(sigma)[number][1]
        np.testing.assert_allclose(slopes, (above - below) / (2.0 * step), rtol=1e-5, atol=1e-9)


def own(path, body):
    text = f"import numpy as np\ndef law(conditions):\n    at = conditions\n    {body}"
    (path / "mine.py").write_text(text)
    return OwnRheology(OwnFunction(f"{path}/mine.py:law"))


def test_one_s_own_law_knows_the_conditions(tmp_path):
    law = own(tmp_path, "return 5e6 * np.arcsinh(at.viscosity * at.shear_rate / 5e6)")
    law.check(2e9, 0.1, 1e6)
    np.testing.assert_allclose(law.shear_stress(at(1e7)), Eyring(5e6).shear_stress(at(1e7)), rtol=1e-14)


@pytest.mark.parametrize("body", ["return -at.pressure", "return at.pressure * np.nan"])
def test_what_is_no_stress_is_refused_with_its_place(tmp_path, body):
    with pytest.raises(OwnFunctionError, match="1e[+]06 1/s; must be a shear stress in Pa, not below 0"):
        own(tmp_path, body).check(2e9, 0.1, 1e6)
