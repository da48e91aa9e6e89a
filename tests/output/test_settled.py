"""When means over passages count as settled."""

from dataclasses import replace

import numpy as np
import pytest

import mgehl
from mgehl.kinds import checked_case
from mgehl.model.course import Table
from mgehl.output.series import have_settled


@pytest.fixture(scope="module")
def scene():
    return checked_case(mgehl.load(None, {"time.end": 1.0, "motion.speed": 0.1, "grid.nodes": 65})).scene


def rows(scene, passages, gap):
    """Ten steps in each passage; `gap(k)` of the k-th step."""
    way = 1e5 * scene.passage()
    return [
        {"step_s": 1e-4, "time_s": (k + 1) * 1e-4, "load_share": 1.0, "path_x_um": (k + 1) * way,
         "path_y_um": 0.0, "mean_gap_nm": gap(k), "load_on_solids": 0.0}
        for k in range(10 * passages)
    ]  # fmt: skip


def test_waves_that_pass_have(scene):
    assert have_settled(rows(scene, 4, lambda k: 100.0 + 30.0 * np.sin(0.2 * np.pi * k)), scene)
    assert not have_settled(rows(scene, 2, lambda k: 100.0), scene)


def test_passages_count_from_when_the_load_stays(scene, tmp_path):
    (tmp_path / "load.csv").write_text("0,20\n0.001,30\n0.002,40\n1,40\n")
    rising = replace(scene, load=Table(str(tmp_path / "load.csv")))
    assert rising.stays_from == 0.002
    assert [have_settled(rows(rising, count, lambda k: 100.0), rising) for count in (4, 5)] == [False, True]


def test_a_film_that_approaches_its_limit_slowly_has_not(scene):
    """It changed by .9 % in a passage, and 9 % were left."""

    def approached(passages):
        return have_settled(rows(scene, passages, lambda k: 100.0 + 10.0 * 0.99**k), scene)

    assert not approached(4) and not approached(20) and approached(30)


def test_a_film_whose_steps_are_longer_than_a_passage_has_not(scene):
    long = [each | {"path_x_um": 15.0 * each["path_x_um"]} for each in rows(scene, 1, lambda k: 100.0)]
    assert not have_settled(long, scene)
