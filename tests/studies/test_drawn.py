"""What studies of drawn contacts share."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

from mgehl.config import config_from_tables, load_config
from mgehl.kinds import contact_from
from mgehl.solver.from_config import scheme_from
from mgehl.studies.drawn import AS_BY_DEFAULT, p_h_of_one, summary


def result(convolutions, band, **verdict):
    """What a summary asks of a `Result`."""
    error = None if band is None else SimpleNamespace(mean_nm=band)
    work, mixed = SimpleNamespace(convolutions=convolutions), SimpleNamespace(error=error)
    return SimpleNamespace(**{"converged": True, "settled": True} | verdict, work=work, mixed=mixed)


def test_the_summary_counts_bands_and_work_of_what_converged():
    results = [
        result(100.0, 0.2),
        result(200.0, None),
        result(600.0, 0.1),
        result(9.0, 0.1, converged=False),
        result(9.0, 0.1, converged=False, settled=False),
    ]
    said = {each["what"]: each["value"] for each in summary(results)}
    assert said["of the converged, with a band about the mean gap"] == "2"
    verdicts = said["converged"], said["settled, and in doubt"], said["not settled"]
    assert verdicts == ("3 (60.0 %)", "1", "1")
    assert said["convolutions of the converged, mean"] == "300.0"
    assert said["convolutions of the converged, median"] == "200.0"


def test_schemes_are_those_of_a_case_of_ones_own():
    rough = {"surface.kind": "waviness", "surface.amplitude": 1e-7, "surface.wavelength_x": 1e-4}
    config = load_config(settings={"grid.nodes": 65, **rough})
    config = replace(config, discretization=replace(config.discretization, couette=None))
    named = AS_BY_DEFAULT["discretization"]
    assert scheme_from(config, contact_from(config)).couette == named["couette"]


def test_pressure_of_a_load_of_one():
    """The pressure of a ball grows with the cube root of its load."""
    ball = {"radius_x": 0.01, "radius_y": 0.01, "reduced_modulus": 226e9}
    pressed = contact_from(config_from_tables({"contact": ball | {"load": 8.0}}))
    assert pressed.hertz.p_h == pytest.approx(2.0 * p_h_of_one(ball, "load"), rel=1e-12)
