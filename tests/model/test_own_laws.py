import numpy as np
import pytest
from told import refusal

from mgehl.config import config_from_tables
from mgehl.kinds import contact_from
from mgehl.model.conditions import Conditions
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


def refused(check, *arguments):
    start, _, what = refusal(check, *arguments, error=OwnFunctionError).partition("mine.py:law': ")
    assert start.startswith("'/")
    return what


def test_viscosity_of_one_s_own_is_the_built_in_one(viscosity):
    law = viscosity(BARUS)
    law.check(2.0 * P_H)
    value, slope = law.log_viscosity(P, P_H)
    expected, expected_slope = Barus(0.05, 18e-9).log_viscosity(P, P_H)
    np.testing.assert_allclose(value, expected, rtol=1e-13, atol=1e-15)
    np.testing.assert_allclose(slope, expected_slope, rtol=1e-13)
    assert (law.viscosity, law.pressure_viscosity) == (0.05, 18e-9)


@pytest.mark.parametrize(
    "slope, words",
    [("pressure_viscosity", "its derivative is wrong: d ln(eta)/dp = "),
     ("1.01 * pressure_viscosity * eta", "= 1.818e-08 at "),
     ("np.where(p > 1.2e9, 0.0, pressure_viscosity * eta)", "differences of the value give 1.8e-08"),
     ("np.where(p > 0.0, pressure_viscosity * eta, np.nan)", "= nan at 0 Pa")],
    ids=["forgotten factor", "a hundredth too much", "wrong at high pressure", "none at ambient"],
)  # fmt: skip
def test_a_wrong_derivative_is_refused_with_its_place_and_size(viscosity, slope, words):
    assert words in refused(viscosity(BARUS, slope).check, 2.0 * P_H)


TABLE = """
import numpy as np
KNOTS = np.linspace(0.0, 2e9, 21)
LOGARITHMS = 18e-9 * KNOTS - 2e-18 * KNOTS**2
def law(at):
    eta = at.viscosity * np.exp(np.interp(at.pressure, KNOTS, LOGARITHMS))
    k = np.clip(np.searchsorted(KNOTS, at.pressure, side=SIDE) - 1, 0, 19)
    return eta, eta * np.diff(LOGARITHMS)[k] / 1e8
"""


@pytest.mark.parametrize("side", ["'left'", "'right'"])
def test_a_table_may_have_kinks_where_it_is_checked(own, side):
    """At its knots the derivative is that of either side."""
    OwnViscosity(0.05, 17.8e-9, own(TABLE.replace("SIDE", side))).check(1e9)


def test_conditions_that_nobody_named_are_told(own):
    law = OwnViscosity(0.05, 18e-9, own("def law(at): return at.viscosity * (at.temperature - 300.0), 0.0"))
    assert "(line 1) (at.shear_rate, at.temperature: None here)" in refused(law.check, P_H)


@pytest.mark.parametrize(
    "text, words",
    [
        ("def law(at): return at.viscosity * (1.0 - at.pressure / 1e9), -at.viscosity / 1e9",
         "at 1.01e+09 Pa; must be a positive number"),
        ("def law(at): return at.pressure / (0.0 * at.pressure), 0.0",
         "returns nan at 0 Pa; must be a positive"),
        ("def law(at): return 1e3 * at.viscosity, 0.0",
         "returns 50 at p = 0; must be 0.05, the viscosity that it is given"),
        ("def law(p, v): return p, p", "must take 1 arguments: conditions"),
    ],
)  # fmt: skip
def test_what_is_no_viscosity_is_refused(viscosity, text, words):
    assert words in refused(viscosity(text).check, 2.0 * P_H)


DOWSON = """
def law(at):
    p = at.pressure
    return 1.0 + 0.6e-9 * p / (1.0 + 1.7e-9 * p), 0.6e-9 / (1.0 + 1.7e-9 * p) ** 2
"""


def test_density_of_one_s_own_is_the_built_in_one_and_begins_with_1(own):
    law = OwnDensity(own(DOWSON))
    law.check(2.0 * P_H)
    for found, expected in zip(law.density(P, P_H), DowsonHigginson().density(P, P_H), strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-14)
    absolute = OwnDensity(own(DOWSON.replace("1.0 + 0.6e-9 * p", "870.0 + 0.6e-9 * p")))
    assert "returns 870 at p = 0; must be 1" in refused(absolute.check, 2.0 * P_H)


def test_heights_are_those_of_the_nodes_and_no_higher_than_allowed(own):
    surface = OwnSurface(own("def law(x, y): return 2.0 * x + y**2"))
    x, y = np.array([[1.0, 2.0, 3.0]]), np.array([[0.0], [5.0]])
    assert surface.height(x, y).tolist() == [[2.0, 4.0, 6.0], [27.0, 29.0, 31.0]]
    surface.check(x[0], y[:, 0], 31.0)
    words = refused(surface.check, x[0], y[:, 0], 30.0)
    assert words == "returns 31 at x = 3 m, y = 5 m; must be a height in m of at most 30"


def test_a_compliance_is_positive(own):
    bad = OwnCompliance(own("def law(k): return 50.0 - k"))
    assert refused(bad.check, np.array([1.0, 100.0])) == "returns -50 at 100 1/m; must be a positive number"


def test_laws_are_told_the_temperature_of_the_oil(tmp_path):
    (tmp_path / "warm.py").write_text(
        "import numpy as np\n"
        "def eta(at):\n"
        "    eta = at.viscosity * np.exp(at.temperature / 333.15 * 2e-8 * at.pressure)\n"
        "    return eta, at.temperature / 333.15 * 2e-8 * eta\n"
        "def rho(at):\n"
        "    return 1.0 + 0.0 * at.pressure * at.temperature, 0.0 * at.pressure\n"
        "def tau(at):\n"
        "    return at.temperature + 0.0 * at.pressure\n"
    )
    own = {name: f"{tmp_path / 'warm.py'}:{name}" for name in ("eta", "rho", "tau")}
    walther = {"kinematic_viscosity_40": 1e-4, "kinematic_viscosity_100": 1e-5, "density": 850.0}
    oil = walther | {"temperature": 333.15, "viscosity_law": own["eta"], "density_law": own["rho"]}
    tables = {"lubricant": oil, "friction": {"model": own["tau"]}, "motion": {"speed": 1.0}}
    contact = contact_from(config_from_tables(tables))
    told = contact.lubricant.viscosity_law.log_viscosity(np.array([1.0]), 1e9)
    assert told[0] == pytest.approx(20.0) and told[1] == pytest.approx(20.0)
    assert contact.lubricant.density_law.density(np.array([1.0]), 1e9)[0] == pytest.approx(1.0)
    assert contact.friction.rheology.shear_stress(Conditions(np.ones(1))) == pytest.approx(333.15)
