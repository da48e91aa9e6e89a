from types import SimpleNamespace

import numpy as np
import pytest
from contacts import solved
from mpi4py import MPI

import mgehl
from mgehl import run
from mgehl.config import config_from_tables
from mgehl.errors import UserError
from mgehl.kinds import case_of, contact_from
from mgehl.model.frame import Frame
from mgehl.solver.restart import Forecast, check_start, differing_keys
from mgehl.studies.study import PAPER, PAPERS_DOMAIN, merged, papers_grid

FILM = {"motion": {"speed": 0.5}, "grid": papers_grid(65), "solver": {"start": "film"}}
LINE = {
    "contact": {"kind": "line"},
    "motion": {"speed": 0.3},
    "grid": {"nodes": 129, "x": PAPERS_DOMAIN["x"]},
}
DRY = PAPER | {"motion": {"speed": 5e-6}, "grid": papers_grid(65), "solver": {"start": "contact"}}


@pytest.fixture(scope="module")
def film():
    return solved(FILM)


ROUGH = {"surface.kind": "waviness", "surface.amplitude": "100 nm", "surface.wavelength_x": "40 um"}


@pytest.mark.parametrize(
    ("surface", "change", "leads"),
    [({}, {"motion.speed": 0.4}, True), ({}, {"motion.speed": 5.0}, True),
     ({}, {"motion.speed": 0.1}, False), ({}, {"contact.load": 100.0}, True),
     (ROUGH, {"motion.speed": 0.4}, True), (ROUGH, {"grid.nodes": 129}, True),
     (ROUGH, {"contact.load": 80.5}, True), (ROUGH, {"contact.load": 100.0}, False),
     (ROUGH, {"surface.amplitude": 110e-9}, False)],
)  # fmt: skip
def test_a_forecast_leads_to_films_that_are_near_and_heights_that_stay(surface, change, leads):
    config = mgehl.load(None, {"motion.speed": 0.5, "contact.load": 80.0, "solver.start": "film"} | surface)
    before = SimpleNamespace(contact=contact_from(config))
    contact = contact_from(config.with_(change))
    assert Forecast(before).leads_to(contact, Frame()) is leads


class TestSolveFrom:
    """Its answer is that of a start from nothing, found in fewer steps, all on the finest grid."""

    CASES = {
        "itself": (FILM, {}),
        "a coarser grid": (FILM, {"grid": papers_grid(129)}),
        "another domain": (FILM | {"motion": {"speed": 1.0}},
                           {"grid": {"x": [-2.2, 1.4], "y": [-1.7, 1.7]}}),
        "another speed": (FILM, {"motion": {"speed": 0.6}}),
        "ambient": (FILM | {"contact": {"ambient_pressure": 2e7}}, {"contact": {"ambient_pressure": 5e6}}),
        "a line": (LINE, {}),
        "contact": (DRY, {}),
    }  # fmt: skip

    @pytest.mark.parametrize("name", CASES)
    def test_from(self, name):
        before, change = self.CASES[name]
        plain = solved(before, change)
        started = solved(before, change, start=solved(before))
        assert started.result.converged and plain.result.converged
        np.testing.assert_allclose(started.fields.P, plain.fields.P, rtol=0.0, atol=1e-6)
        np.testing.assert_allclose(started.fields.H, plain.fields.H, rtol=0.0, atol=1e-6)
        np.testing.assert_array_equal(started.fields.status, plain.fields.status)
        assert started.result.work.steps < plain.result.work.steps
        assert {row["grid"] for row in started.rows} == {plain.mesh.nx}

    def test_a_far_speed_is_reached_in_steps(self, film):
        started = solved(FILM, {"motion": {"speed": 4.0}}, start=film)
        plain = solved(FILM, {"motion": {"speed": 4.0}})
        assert started.result.converged
        np.testing.assert_allclose(started.fields.H, plain.fields.H, rtol=0.0, atol=1e-6)

    def test_a_forecast_from_afar_begins_from_nothing(self):
        """A twentieth of the speed: by the same steps as without a neighbour."""
        slow = {"motion": {"speed": 0.025}, "discretization": {"face_mobility": "linear-gap"}}
        case = run.enter(config_from_tables(merged(FILM, slow)), MPI.COMM_SELF)
        far, plain = run.solve(case, MPI.COMM_SELF, run.Watch(), Forecast(solved(FILM))), solved(FILM, slow)
        assert far.result.work == plain.result.work
        assert far.result.recipe["begins"] == plain.result.recipe["begins"]


def test_a_contact_of_another_kind_is_no_start(film):
    with pytest.raises(UserError, match="a point is no start for a line"):
        check_start(film, case_of(mgehl.load(None, {"contact.kind": "line"})))


def test_what_tells_another_contact_is_named():
    """Loads, speeds and grids are what a start is for."""
    start = SimpleNamespace(config=mgehl.load(None, {"grid.nodes": 65}))
    same = mgehl.load(None, {"grid.nodes": 129, "motion.speed": 1.0, "contact.load": 100.0})
    assert list(differing_keys(start, same)) == []
    other = mgehl.load(None, {"contact.radius_y": 0.02, "lubricant.viscosity_law": "roelands"})
    assert list(differing_keys(start, other)) == ["contact.radius_y", "lubricant.viscosity_law"]
