from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from contacts import solved

import mgehl
from mgehl.discretization.mesh import Mesh
from mgehl.model.rheology import Friction
from mgehl.output import friction_result as module
from mgehl.output.friction_result import banded, friction_lines, friction_result, with_moments
from mgehl.output.gap_error import GapError, GridGap, no_band
from mgehl.output.report.run_report import report
from mgehl.solver.shear import Shear

MESH = Mesh(65, 65, (-40.0, 40.0), (-40.0, 40.0))


@pytest.fixture
def found(paper_contact, monkeypatch):
    """Of the paper's ball at 1 m/s: 40 N of film, 8 N of solids, .5 and .3 N of rolling."""

    def make(slide_to_roll):
        contact = paper_contact(friction=Friction(slide_to_roll=slide_to_roll))
        grid = SimpleNamespace(max=float, mesh=MESH)
        problem = SimpleNamespace(contact=contact, grid=grid, load_share=1.0, sense=1.0)
        forces = (40.0, 8.0) if slide_to_roll else (0.0, 0.0)
        shear = Shear(1e6, 2e6, *forces, (0.5, 0.3))
        monkeypatch.setattr(module, "shear_of", lambda *_: shear)
        monkeypatch.setattr(module, "flows_out_whole", lambda *_: True)
        return friction_result(problem, None)[0]

    return make


@pytest.mark.parametrize("slide_to_roll", [0.2, -0.2, 2.0, 0.0])
def test_the_loss_is_what_the_forces_take_from_the_bodies(found, slide_to_roll):
    result = found(slide_to_roll)
    u_1, u_2 = 1.0 + 0.5 * slide_to_roll, 1.0 - 0.5 * slide_to_roll
    assert result.power_loss_W == pytest.approx(-result.force_1_N * u_1 - result.force_2_N * u_2)


def test_moments_lose_what_forces_do(found):
    """A ball of 4 mm and a disc that touches it 30 mm from its axis, at the speeds of the bodies."""
    result = with_moments(found(0.2), (4e-3, 30e-3))
    turned = result.moment_1_Nm * 1.1 / 4e-3 + result.moment_2_Nm * 0.9 / 30e-3
    assert result.power_loss_W == pytest.approx(-turned)
    assert with_moments(found(0.2), (4e-3, None)).moment_2_Nm is None


@pytest.mark.parametrize(
    "model, coefficient, said", [("own", 2e-9, 1), ("own", 2e-5, 0), ("eyring", 2e-9, 0)]
)
def test_a_law_of_another_unit_is_named(found, model, coefficient, said):
    """A function that returned a viscosity made a friction of 0.00000, without a word."""
    words = list(friction_lines(replace(found(0.2), model=model, coefficient=coefficient), verbose=False))
    assert sum("the law's stress is to be in Pa" in line for line in words) == said


def by_grids(solids, friction=1e-4):
    grids = (GridGap(129, 10.0, 9.0, 0.3, True, max_pressure_GPa=2.0),)
    return GapError(0.1, 0.1, "", grids, solid_load_fraction=solids, friction=friction)


def test_the_band_of_the_load_on_solids_is_friction_s(found):
    result = banded(found(0.2), by_grids(0.02), 0.1)
    assert result.coefficient_band == pytest.approx(0.002) and not result.is_the_grids
    (line,) = friction_lines(result, verbose=False)
    assert line.startswith("friction 0.060 ± 0.002 (newtonian): film 0.05000, solids 0.01000; rolling")
    line, _ = friction_lines(replace(result, film_coefficient=2e7, largest_shear_MPa=4e6), verbose=False)
    assert line.startswith("friction out of range (newtonian: the film would drag by 2e+07 times the load)")


def test_where_there_is_no_band_at_all_friction_is_the_grid_s_too(found):
    """A soft ball whose inlet no grid saw: 44 % too much of it, and no word."""
    unseen, not_asked = (
        banded(found(0.2), no_band("the inlet ..."), 0.1, asked) for asked in (True, False)
    )
    assert unseen.is_the_grids and not not_asked.is_the_grids


@pytest.mark.parametrize("solids, friction", [(None, 1e-4), (0.02, None)])
def test_where_the_load_on_solids_or_shear_is_the_grid_s_so_is_friction(found, solids, friction):
    result = banded(found(0.2), by_grids(solids, friction), 0.1)
    assert result.coefficient_band is None and result.is_the_grids
    _, line, *_ = friction_lines(result, verbose=False)
    assert line == "no band of friction: another grid may give another coefficient"


def test_a_run_that_slides_has_its_shear_in_report_and_files(tmp_path):
    """Maps by their names, read back as they were."""
    solution = solved({
        "contact": {"load": 100.0}, "motion": {"speed": 0.5, "slide_to_roll": 0.2}, "grid": {"nodes": 65},
        "friction": {"model": "limiting", "limiting_coefficient": 0.05},
        "solver": {"start": "film", "error": False},
    })  # fmt: skip
    solution.save(tmp_path / "here")
    read = mgehl.read(tmp_path / "here")
    np.testing.assert_array_equal(read.fields.shear, solution.fields.shear)
    assert read.summary.friction == solution.summary.friction and read.fields.heights is None
    page = report(read, "here")
    assert "hear stress by sliding" in page


@pytest.mark.parametrize("surface", [None, {"kind": "waviness", "amplitude": 1e-7, "wavelength_x": 2e-4}])
def test_the_film_without_thinning_is_told_beside_the_thinned_one(surface):
    """Of rough bodies the mean gap."""
    tables = {
        "grid": {"nodes": 65}, "motion": {"speed": 2.0, "slide_to_roll": 0.3},
        "friction": {"model": "eyring", "eyring_stress": 5e6}, "solver": {"start": "film"},
    } | ({"surface": surface} if surface else {})  # fmt: skip
    thinned, thick = (solved(tables, {"friction": own}).result for own in ({}, {"thinning": False}))
    film = thick.mixed.mean_gap_nm if surface else thick.central_film_nm
    assert thinned.converged and thinned.friction.unthinned_film_nm == pytest.approx(film, rel=1e-5)
    assert thick.friction.unthinned_film_nm is None
    name, minimum = "mean gap" if surface else "central film", thick.minimum_film_nm
    assert f"without that the {name} would be {round(film, -1):.0f} ± " in str(thinned)
    assert thinned.friction.unthinned_minimum_nm == pytest.approx(minimum, rel=1e-5)
