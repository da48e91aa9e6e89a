import pytest
from contacts import solved

import mgehl

OIL = {"conductivity": 0.14, "thermoviscosity": 0.04}
STEEL = {"conductivity_1": 46.0, "conductivity_2": 46.0, "capacity_1": 3.6e6, "capacity_2": 3.6e6}

SLIDES = {
    "contact": {"load": 100.0}, "motion": {"speed": 2.0, "slide_to_roll": 0.2}, "grid": {"nodes": 65},
    "friction": {"model": "limiting", "limiting_coefficient": 0.05},
    "solver": {"start": "film", "error": False},
}  # fmt: skip


def test_the_factor_thins_the_film_by_as_much(tmp_path):
    """Through the viscosity: the film follows it by the formula's power, nearly. A run's files tell it."""
    heatings = "none", "factor"
    plain, solution = (solved(SLIDES, {"lubricant": OIL | {"heating": each}}) for each in heatings)
    plain, heated = plain.summary, mgehl.read(solution.save(tmp_path / "run")).summary
    assert plain.thermal_reduction == heated.thermal_reduction < 0.95
    ratio = heated.central_film_nm / plain.central_film_nm
    assert ratio == pytest.approx(plain.thermal_reduction, abs=0.01)
    assert (plain.groups, plain.formulas) == (heated.groups, heated.formulas)  # the oil's own
    assert "isothermal film; shear in the inlet would take some" in plain.words()
    assert "shear in the inlet has taken some" in heated.words()


def test_temperatures_of_a_solved_contact():
    """Both bodies are alike and nearly as fast: nearly as warm; the faster one is the cooler."""
    solution = solved(SLIDES, {"lubricant": OIL, "heat": STEEL})
    found = solution.summary.friction.temperatures
    assert found.largest_1 == pytest.approx(solution.fields.flash_1.max())
    assert 0.9 < found.largest_1 / found.largest_2 < 1.0
    assert found.largest_film > found.film > 0.0


def test_oil_that_tells_no_conductivity_has_the_usual_one():
    """Oil that conducts without end would make steel and glass as warm as each other."""
    bodies = STEEL | {"conductivity_2": 1.0, "capacity_2": 2e6}
    told, usual = (
        solved(SLIDES, {"lubricant": oil, "heat": bodies}) for oil in ({"conductivity": 0.14}, {})
    )
    assert usual.summary.friction.temperatures == told.summary.friction.temperatures
    assert told.summary.friction.temperatures.largest_2 > 1.5 * told.summary.friction.temperatures.largest_1
