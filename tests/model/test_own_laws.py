"""A user's laws, surface and deformation: units, and what is refused before a run."""

import numpy as np
import pytest

from mgehl.model.lubricant import Barus, DowsonHigginson
from mgehl.model.own_function import OwnFunction, OwnFunctionError
from mgehl.model.own_laws import OwnCompliance, OwnDensity, OwnSurface, OwnViscosity

P_H = 0.8e9
P = np.array([[0.0, 0.25, 1.0, 1.7]])
BARUS = """
import numpy as np
def law(at):
    p, viscosity, pressure_viscosity = at.pressure, at.viscosity, at.pressure_viscosity
    eta = viscosity * np.exp(pressure_viscosity * p)
    return eta, SLOPE
"""
DOWSON = """
def law(at):
    p = at.pressure
    return 1.0 + 0.6e-9 * p / (1.0 + 1.7e-9 * p), SLOPE
"""


@pytest.fixture
def own(tmp_path):
    def make(text):
        (tmp_path / "mine.py").write_text(text)
        return OwnFunction(f"{tmp_path}/mine.py:law")

    return make


@pytest.fixture
def viscosity(own):
    return lambda text, slope="pressure_viscosity * eta": OwnViscosity(
        0.05, 18e-9, own(text.replace("SLOPE", slope))
    )


@pytest.fixture
def density(own):
    return lambda text, slope="0.6e-9 / (1.0 + 1.7e-9 * p) ** 2": OwnDensity(
        own(text.replace("SLOPE", slope))
    )


def refusal(check, *arguments):
    with pytest.raises(OwnFunctionError) as caught:
        check(*arguments)
    message = str(caught.value)
    assert "mine.py:law': " in message and "\n" not in message
    return message.partition("mine.py:law': ")[2]


def test_viscosity_of_one_s_own_is_the_built_in_one(viscosity):
    law = viscosity(BARUS)
    law.check(2.0 * P_H)
    value, slope = law.log_viscosity(P, P_H)
    expected, expected_slope = Barus(0.05, 18e-9).log_viscosity(P, P_H)
    np.testing.assert_allclose(value, expected, rtol=1e-13, atol=1e-15)
    np.testing.assert_allclose(slope, expected_slope, rtol=1e-13)
    assert (law.viscosity, law.pressure_viscosity) == (0.05, 18e-9)


def test_density_of_one_s_own_is_the_built_in_one(density):
    law = density(DOWSON)
    law.check(2.0 * P_H)
    for found, expected in zip(law.density(P, P_H), DowsonHigginson().density(P, P_H), strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-14)


def test_below_ambient_pressure_a_viscosity_goes_on_as_a_line(viscosity):
    """The function is asked for p = 0 there: what it may not hold for, it is not asked."""
    value, slope = viscosity(BARUS).log_viscosity(np.array([-2.0]), P_H)
    assert value[0] == pytest.approx(-2.0 * 18e-9 * P_H, rel=1e-14)
    assert slope[0] == pytest.approx(18e-9 * P_H, rel=1e-14)


def test_below_ambient_pressure_a_density_goes_on_as_a_line(density):
    rho, rise = density(DOWSON).density(np.array([-0.5]), P_H)
    assert rho[0] == pytest.approx(1.0 - 0.5 * 0.6e-9 * P_H, rel=1e-14)
    assert rise[0] == pytest.approx(0.6e-9 * P_H, rel=1e-14)


@pytest.mark.parametrize(
    "slope, words",
    [
        ("pressure_viscosity", "its derivative is wrong: d ln(eta)/dp = "),
        ("1.01 * pressure_viscosity * eta", "= 1.818e-08 at "),
        ("np.where(p > 1.2e9, 0.0, pressure_viscosity * eta)", "differences of the value give 1.8e-08"),
        ("np.where(p > 0.0, pressure_viscosity * eta, np.nan)", "= nan at 0 Pa"),
    ],
    ids=["forgotten factor", "a hundredth too much", "wrong at high pressure", "none at ambient"],
)
def test_a_wrong_derivative_is_refused_with_its_place_and_size(viscosity, slope, words):
    assert words in refusal(viscosity(BARUS, slope).check, 2.0 * P_H)


@pytest.mark.parametrize("law", ["viscosity", "density"])
def test_constant_laws_pass(viscosity, density, law):
    if law == "viscosity":
        viscosity("def law(at): return at.viscosity, 0.0").check(P_H)
    else:
        density("def law(at): return 1.0, 0.0").check(P_H)


def test_a_density_s_wrong_derivative_is_refused(density):
    message = refusal(density(DOWSON, "0.6e-9 / (1.0 + 1.7e-9 * p)").check, 2.0 * P_H)
    assert message.startswith("its derivative is wrong: d rho/dp = ")


@pytest.mark.parametrize(
    "text, words",
    [
        (
            "def law(at): return at.viscosity * (1.0 - at.pressure / 1e9), -at.viscosity / 1e9",
            "at 1.01e+09 Pa; must be a positive number",
        ),
        (
            "def law(at): return at.pressure / (0.0 * at.pressure), 0.0",
            "returns nan at 0 Pa; must be a positive",
        ),
        (
            "def law(at): return 1e3 * at.viscosity, 0.0",
            "returns 50 at p = 0; must be 0.05, the viscosity that it is given",
        ),
        ("def law(p, v): return p, p", "must take 1 arguments: conditions"),
    ],
)
def test_what_is_no_viscosity_is_refused(viscosity, text, words):
    assert words in refusal(viscosity(text).check, 2.0 * P_H)


def test_a_density_in_kg_is_refused(density):
    assert "returns 870 at p = 0; must be 1" in refusal(
        density("def law(at): return 870.0, 0.0").check, P_H
    )


def test_a_law_that_cannot_take_a_plane_of_nodes_is_refused(density):
    """Nodes come as (lines, nx), and so does what is checked."""
    text = "def law(at): return [1.0 + 0.0 * each for each in range(len(at.pressure))], 0.0"
    assert "must return numbers of shape (101, 1)" in refusal(density(text).check, P_H)


def test_heights_are_those_of_the_nodes(own):
    surface = OwnSurface(own("def law(x, y): return 2.0 * x + y**2"))
    x, y = np.array([[1.0, 2.0, 3.0]]), np.array([[0.0], [5.0]])
    assert surface.height(x, y).tolist() == [[2.0, 4.0, 6.0], [27.0, 29.0, 31.0]]
    surface.check(x[0], y[:, 0], 31.0)


@pytest.mark.parametrize(
    "text, words",
    [
        (
            "def law(x, y): return x + 0.0 * y",
            "returns 3 at x = 3 m, y = 0 m; must be a height in m of at most 2.5",
        ),
        ("def law(x, y): return x / (y - 5.0) / 1e3 ", "returns inf at x = 1 m, y = 5 m"),
        ("def law(x, y): return (x, y)", "must return numbers of shape (1, 3)"),
        ("def law(x): return x", "must take 2 arguments: x, y"),
    ],
)
def test_what_is_no_surface_is_refused(own, text, words):
    surface = OwnSurface(own(text))
    assert words in refusal(surface.check, np.array([1.0, 2.0, 3.0]), np.array([0.0, 5.0]), 2.5)


def test_a_compliance_is_positive(own):
    k = np.array([1.0, 10.0, 100.0])
    good = OwnCompliance(own("def law(k): return 1.0 + 1.0 / k"))
    good.check(k)
    assert good.compliance(k).tolist() == [2.0, 1.1, 1.01]
    bad = OwnCompliance(own("def law(k): return 50.0 - k"))
    assert refusal(bad.check, k) == "returns -50 at 100 1/m; must be a positive number"


class TestAfterItWasChecked:
    """A law may turn into none in the middle of a run, or above the pressures that are checked."""

    HIGH = np.array([[0.5, 6.0, 40.0]])
    """In p_h: checked, high as on peaks of rough bodies, and of an iteration that diverges."""

    @pytest.mark.parametrize("value", ["np.nan", "np.inf", "-1.0", "0.0"])
    def test_a_viscosity_that_is_no_number_is_refused_with_its_pressure(self, viscosity, value):
        text = BARUS.replace("return eta,", f"return np.where(p > 5 * {P_H}, {value}, eta),")
        law = viscosity(text)
        law.check(2.0 * P_H)
        words = "at 4.8e+09 Pa; must be a positive number"
        assert words in refusal(law.log_viscosity, self.HIGH, P_H)

    @pytest.mark.parametrize("value", ["np.nan", "np.inf", "-1.0", "0.0"])
    def test_a_density_that_is_no_number_is_refused_with_its_pressure(self, density, value):
        text = "import numpy as np\ndef law(at): return np.where(at.pressure > 4e9, VALUE, 1.0), 0.0"
        law = density(text.replace("VALUE", value))
        law.check(2.0 * P_H)
        assert "at 4.8e+09 Pa; must be a positive number" in refusal(law.density, self.HIGH, P_H)

    @pytest.fixture(params=["viscosity", "density"])
    def with_slope(self, request, viscosity, density):
        """A law with a derivative of one's own."""
        if request.param == "viscosity":
            return lambda slope: viscosity(BARUS, slope).log_viscosity
        return lambda slope: density("import numpy as np" + DOWSON, slope).density

    def test_so_is_a_derivative(self, with_slope):
        found = refusal(with_slope("np.where(p > 4e9, np.nan, 0.0)"), self.HIGH, P_H)
        assert found == "its derivative is nan at 4.8e+09 Pa; must be a number"

    def test_where_an_iteration_diverges_there_is_no_law(self, with_slope):
        """The solve ends there by itself, or begins anew on a finer grid."""
        value = with_slope("np.where(p > 8e9, np.nan, 0.0)")(self.HIGH, P_H)[0]
        np.testing.assert_array_equal(np.isnan(value), [[False, False, True]])

    def test_heights_that_are_no_numbers_are_refused(self, own):
        text = "import numpy as np\ndef law(x, y): return np.where(x > 1e-3, np.nan, 0.0 * y)"
        surface = OwnSurface(own(text))
        assert surface.height(0.0, np.zeros(3)).shape == (3,)
        assert "returns nan at x = 0.002 m, y = 0 m" in refusal(surface.height, np.array([0.0, 2e-3]), 0.0)

    def test_a_compliance_that_is_no_number_is_refused(self, own):
        law = OwnCompliance(own("import numpy as np\ndef law(k): return np.where(k > 1e4, np.nan, 1.0)"))
        assert "returns nan at 2e+04 1/m" in refusal(law.compliance, np.array([1e3, 2e4]))
