"""Temperatures of a contact, and the film that the heat of shear in the inlet leaves."""

import pytest

import mgehl
from mgehl.config import config_from_tables
from mgehl.errors import ConfigError
from mgehl.kinds import contact_from
from mgehl.output.mixed_words import heating_words

OIL = {"conductivity": 0.14, "thermoviscosity": 0.04}
STEEL = {"conductivity_1": 46.0, "conductivity_2": 46.0, "capacity_1": 3.6e6, "capacity_2": 3.6e6}


def tables(**sections):
    common = {
        "contact": {"load": 100.0},
        "motion": {"speed": 2.0, "slide_to_roll": 0.2},
        "friction": {"model": "limiting", "limiting_coefficient": 0.05},
        "grid": {"nodes": 65},
        "solver": {"start": "film", "error": False},
    }
    return common | sections


def test_the_factor_thins_the_film_by_as_much(tmp_path):
    """Through the viscosity: the film follows it by the formula's power, nearly. A run's files tell it."""
    plain, solution = (
        mgehl.solve(config_from_tables(tables(lubricant=OIL | {"heating": heating})))
        for heating in ("none", "factor")
    )
    plain, heated = plain.summary, mgehl.read(solution.save(tmp_path / "run")).summary
    assert plain.thermal_reduction == heated.thermal_reduction < 0.95
    ratio = heated.central_film_nm / plain.central_film_nm
    assert ratio == pytest.approx(plain.thermal_reduction, abs=0.01)
    assert "isothermal film; shear in the inlet would take some" in plain.words()
    assert "shear in the inlet has taken some" in heated.words()


@pytest.mark.parametrize("reduction", [None, 0.995])
def test_nothing_is_said_of_less_than_a_per_cent(reduction):
    assert heating_words(reduction, False) == []


def test_temperatures_of_a_solved_contact():
    """Both bodies are alike and nearly as fast: nearly as warm; the faster one is the cooler."""
    solution = mgehl.solve(config_from_tables(tables(lubricant=OIL, heat=STEEL)))
    found = solution.summary.friction.temperatures
    assert found.largest_1 == pytest.approx(solution.fields.flash_1.max())
    assert 0.9 < found.largest_1 / found.largest_2 < 1.0
    assert found.largest_film > found.film > 0.0


@pytest.mark.parametrize(
    "sections, message",
    [
        ({"lubricant": {"heating": "factor"}}, "lubricant.conductivity: must be given where"),
        (
            {"heat": {"conductivity_1": 46.0}},
            "heat.conductivity_2: must be given beside heat.con",
        ),
        ({"heat": STEEL | {"capacity_2": 1.0}}, "heat.capacity_2 = 1.0: must be a number in J/m^3/K"),
    ],
)
def test_what_is_missing_is_named(sections, message):
    with pytest.raises(ConfigError) as caught:
        config_from_tables(tables(**sections))
    assert message in str(caught.value)


def test_far_beyond_its_range_the_factor_is_refused():
    oil = OIL | {"heating": "factor"}
    config = config_from_tables(tables(lubricant=oil, motion={"speed": 100.0}))
    with pytest.raises(ConfigError, match="shear would leave .* of the film; it must be at least 0.2"):
        mgehl.solve(config)
    assert contact_from(config).lubricant.thinned > 0.0
