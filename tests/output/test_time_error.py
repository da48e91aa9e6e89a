"""The bands about a run in time, by the next coarser grid in steps of two."""

from dataclasses import make_dataclass

import numpy as np
import pytest
from mpi4py import MPI

import mgehl
from mgehl.errors import Stopped
from mgehl.kinds import checked_case
from mgehl.output.series import MEANS
from mgehl.output.time_error import from_a_start, from_rows
from mgehl.run import Watch, enter, run

UNIT = 1.52e-3
BALL = {
    "contact.load": 15.0, "contact.radius_x": 0.0125, "contact.radius_y": 0.0125,
    "contact.reduced_modulus": 110e9, "lubricant.viscosity": 0.25, "lubricant.viscosity_law": "roelands",
    "lubricant.pressure_viscosity": 22e-9, "motion.speed": 0.09, "grid.nodes": 65, "solver.start": "film",
}  # fmt: skip
DENT = {
    "surface.kind": "dent", "surface.amplitude": 1e-7, "surface.width": 1e-4, "surface.body": "body_1",
    "surface.x": -1e-4, "time.end": 0.3 * UNIT,
}  # fmt: skip


def scene(**more):
    named = {key.replace("__", "."): value for key, value in more.items()}
    return checked_case(mgehl.load(None, BALL | {"time.end": 5.0 * UNIT} | named)).scene


def row(t, step, value, **more):
    columns = {name: value for name in MEANS} | {"pressure_crest": 0.0, "load_on_solids": 0.0}
    way = 1e6 * 0.09 * t
    return columns | {"grid": 65, "time_s": t, "step_s": step, "path_x_um": way, "path_y_um": 0.0,
                      "load_share": 1.0, "load_on_contact": 0.0} | more  # fmt: skip


def rows(value, coarse=1, steps=8):
    """Of steps of a fourth of a Hertz radius, or `coarse` times as long; `value(k)` is that of the k-th."""
    dt = coarse * 0.25 * UNIT
    return [row((k + 1) * dt, dt, value(k), grid=65 // coarse) for k in range(steps // coarse)]


def test_what_grids_tell_too_differently_has_no_band():
    found = from_rows(rows(lambda k: 100.0), rows(lambda k: 160.0, coarse=2), scene())
    assert found.at_the_end == {}


def test_a_start_s_band_is_added_until_a_passage_has_gone():
    """The coarser grid begins with the same film: a squeezed film had 0.006 nm for 1.4."""
    found = from_rows(rows(lambda k: 100.0), rows(lambda k: 101.0, coarse=2), scene())
    start = make_dataclass("Start", ["error"])({"central_nm": 1.4, "minimum_nm": None})
    there = from_a_start(found, start, 0.5).at_the_end
    assert there["central_film_nm"] == there["mean_gap_nm"] == found.at_the_end["central_film_nm"] + 1.4
    assert "minimum_film_nm" not in there and from_a_start(found, start, 2.0) is found
    later, name = from_a_start(found, start, 1.75), "central_film_nm"
    assert later.at_the_end == found.at_the_end and later.means[name] == found.means[name] + 0.35


def test_the_mean_load_on_contact_that_opens_has_no_band():
    """It hangs on when: a ball that starts from rest had .09 ± .07 for .2."""

    def told(every, share):
        found = rows(lambda k: 1.0, every)
        shares = ({"load_on_contact": share(k), "load_on_solids": 0.1 * share(k)} for k in range(99))
        return [each | of for each, of in zip(found, shares, strict=False)]

    def from_shares(fine, coarse):
        return from_rows(told(1, fine), told(2, coarse), scene()).means

    opens = from_shares(lambda k: float(k < 4), lambda k: float(k < 2))
    assert opens.keys().isdisjoint({"load_on_contact", "load_on_solids"})
    assert from_shares(lambda k: 0.03, lambda k: 0.04)["load_on_contact"] == pytest.approx(0.015)


def test_a_spike_that_three_nodes_do_not_hold_leaves_pressure_and_friction_without_bands():
    fine = [each | {"pressure_crest": 0.04} for each in rows(lambda k: 1.0)]
    fine[-1]["pressure_crest"] = 0.01
    coarse = [each | {"minimum_film_nm": 1.001} for each in rows(lambda k: 1.1, coarse=2)]
    found = from_rows(fine, coarse, scene())
    assert {"max_pressure_GPa", "friction"}.isdisjoint(found.means) and "mean_gap_nm" in found.means
    assert found.means["minimum_film_nm"] == found.means["central_film_nm"]  # no grid knows it better
    assert {"max_pressure_GPa", "friction"} <= found.at_the_end.keys()


def test_after_a_reversal_pressure_and_friction_have_no_bands(tmp_path):
    """A line's had 1.228 ± .015 GPa in steps of four cells, and 1.288 in fine ones."""
    (tmp_path / "speed.csv").write_text(f"0,0.09\n{2.5 * UNIT},-0.09\n{6.0 * UNIT},-0.09\n")
    turns = scene(motion__speed=str(tmp_path / "speed.csv"))
    found = from_rows(rows(lambda k: 1.0), rows(lambda k: 1.1, coarse=2), turns)
    without = {"max_pressure_GPa", "friction"}.isdisjoint(found.at_the_end | found.whole)
    assert without and "mean_gap_nm" in found.at_the_end


@pytest.fixture(scope="module")
def passing():
    return mgehl.solve(mgehl.load(None, BALL | DENT))


def test_a_finer_grid_in_shorter_steps_ends_within_the_bands(passing):
    finer = mgehl.solve(mgehl.load(None, BALL | DENT | {"grid.nodes": 129, "solver.error": False}))
    end, half = passing.rows[-1], passing.summary.time.error.at_the_end
    assert set(half) >= {"mean_gap_nm", "central_film_nm", "minimum_film_nm"}
    for name, width in half.items():
        assert 0.0 < abs(finer.rows[-1][name] - end[name]) < width < 0.5 * end[name]


def test_they_are_told_and_take_a_tenth_of_the_work(passing):
    result, work = passing.summary, passing.summary.work.convolutions
    assert 0.01 * work < result.time.error.convolutions < 0.2 * work
    assert result.mixed.error.mean_nm == result.time.error.at_the_end["mean_gap_nm"]
    assert "bands of gap, pressure and load: from the differences to 33 nodes" in str(result)
    assert {each["grid"] for each in passing.rows} == {65}


def test_films_of_smooth_bodies_have_them_and_none_that_did_not_ask():
    short = {"motion.speed": 0.09, "time.end": 0.1 * UNIT}
    film = mgehl.solve(mgehl.load(None, BALL | short)).summary
    assert 0.0 < film.error.central_nm < 0.05 * film.central_film_nm
    film = mgehl.solve(mgehl.load(None, BALL | short | {"solver.error": False})).summary
    assert film.error.central_nm is None and "not asked for" in film.time.error.how


def test_films_of_an_inlet_of_less_than_a_cell_have_none_as_steady_ones():
    slow = {"contact.load": 100.0, "motion.speed": 0.02, "time.end": 0.5 * UNIT}
    result = mgehl.solve(mgehl.load(None, BALL | slow)).summary
    assert result.resolution.inlet_cells < 1.0 and not result.contact.nodes
    known = result.time.error.at_the_end
    assert "mean_gap_nm" in known and {"central_film_nm", "minimum_film_nm"}.isdisjoint(known)


class Told:
    """Stops a run when it is about to compare grids."""

    row = end = writing = lambda *_, **__: None
    compares = False

    def news(self, words):
        self.compares |= "for its bands" in words

    def __call__(self):
        return Stopped("told to", 143) if self.compares else None


def test_a_stop_on_the_way_to_the_bands_loses_nothing(tmp_path, passing):
    case, comm, told = enter(mgehl.load(None, BALL | DENT), MPI.COMM_SELF), MPI.COMM_SELF, Told()
    (tmp_path / "run").mkdir()
    with pytest.raises(Stopped):
        run(case, tmp_path / "run", comm, Watch(speaker=told, stop=told))
    run(case, tmp_path / "run", comm, Watch(picture=False))
    found = mgehl.read(tmp_path / "run")
    assert np.array_equal(found.fields.H, passing.fields.H)
    assert found.summary.time.error.at_the_end == passing.summary.time.error.at_the_end
