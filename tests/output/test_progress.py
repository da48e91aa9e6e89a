"""The history of a run while it runs, and the time that is left."""

import json
from types import SimpleNamespace

import pytest

from mgehl.output.progress import Progress, newton_row
from mgehl.output.terminal import Silent
from mgehl.solver.nested import LevelSolve
from mgehl.solver.outcome import Cycle
from mgehl.solver.partition import Changes

LEVEL = LevelSolve(129, 7.5e-3, True)


def cycle(step):
    return Cycle(step, 1.5e-5, -2e-7, 2e-3, 1e-3, 11, 222, Changes(cavitated=3, released=1), 4, 0.5)


class Told(Silent):
    """Keeps what it is told."""

    def __init__(self):
        self.told = []

    def row(self, row, left=None):
        self.told.append((row, left))

    def news(self, words):
        self.told.append((words, None))


def make_progress(speaker=None, convolutions=0.0):
    """Of a film scale of a micrometre, on a hierarchy of one grid of 129 nodes."""
    grid = SimpleNamespace(mesh=SimpleNamespace(nx=129))
    hierarchy = SimpleNamespace(grids=[grid], convolutions=convolutions)
    return Progress(newton_row, 1e-6, hierarchy, 1e-8, speaker or Told())


def test_a_row_for_each_cycle_is_kept_and_told():
    speaker = Told()
    progress = make_progress(speaker)
    for step, progress._hierarchy.convolutions in ((0, 1.0), (1, 2.5)):
        progress(LEVEL, cycle(step))
    first, second = progress.rows
    expected = {
        "grid": 129, "speed_mm_s": 7.5, "step": 1, "residual": 1.5e-5, "load_error": -2e-7,
        "central_film_nm": 2.0, "minimum_film_nm": 1.0, "contact_nodes": 11, "cavitated_nodes": 222,
        "changed_nodes": 4, "linear_iterations": 4, "step_length": 0.5, "convolutions": 2.5,
    }  # fmt: skip
    assert {key: second[key] for key in expected} == pytest.approx(expected)
    assert second["seconds"] >= first["seconds"] >= 0.0 and first.keys() == second.keys()
    assert [row for row, _ in speaker.told] == progress.rows and progress.steps == 1
    assert speaker.told[0][1] is None and speaker.told[1][1] >= 0.0


def test_it_goes_on_from_its_record():
    before = make_progress(convolutions=30.0)
    before(LEVEL, cycle(0))
    record = json.loads(json.dumps(before.record()))
    record["seconds"] += 100.0
    after = make_progress(convolutions=4.0)
    after.go_on(record)
    assert after.rows == before.rows and after.convolutions == 30.0
    assert 100.0 <= after.seconds < 200.0
    after._hierarchy.convolutions += 2.0
    after(LEVEL, cycle(1))
    assert after.rows[1]["convolutions"] == 32.0 and after.rows[1]["seconds"] >= 100.0
    assert len(before.rows) == 1 and after.steps == 1


def rows(residuals, grid=65, seconds=1.0, first=0.0):
    return [
        {"grid": grid, "step": k, "residual": residual, "seconds": first + k * seconds}
        for k, residual in enumerate(residuals)
    ]
