"""What a run says while it runs."""

import json
from dataclasses import replace
from types import SimpleNamespace

import pytest

from mgehl.output.progress import DRY, NEWTON, RELAXATION, Progress
from mgehl.output.terminal import SILENT, Silent
from mgehl.solver.nested import LevelSolve
from mgehl.solver.outcome import Cycle
from mgehl.solver.partition import Changes

LEVEL = LevelSolve(129, 7.5e-3, True)


def cycle(step):
    return Cycle(step, 1.5e-5, -2e-7, 2e-3, 1e-3, 11, 222, Changes(cavitated=3, released=1), 4, 0.5)


class Told(Silent):
    """Keeps what it is told."""

    def __init__(self, verbose):
        self.told, self.verbose = [], verbose

    def row(self, row, line, left=None):
        self.told.append((row, line, left))

    def news(self, words):
        self.told.append(words)


def make_progress(speaker=SILENT, convolutions=0.0):
    """Of a film scale of a micrometre, on a hierarchy of one grid of 129 nodes."""
    grid = SimpleNamespace(mesh=SimpleNamespace(nx=129))
    return Progress(NEWTON, 1e-6, SimpleNamespace(grids=[grid], convolutions=convolutions), 1e-8, speaker)


def test_a_row_for_each_cycle():
    progress = make_progress()
    for progress._hierarchy.convolutions in (1.0, 2.5):
        progress(LEVEL, cycle(len(progress.rows)))
    first, second = progress.rows
    expected = {
        "grid": 129, "speed_mm_s": 7.5, "step": 1, "residual": 1.5e-5, "load_error": -2e-7,
        "central_film_nm": 2.0, "minimum_film_nm": 1.0, "contact_nodes": 11, "cavitated_nodes": 222,
        "changed_nodes": 4, "linear_iterations": 4, "step_length": 0.5, "convolutions": 2.5,
    }  # fmt: skip
    assert {key: second[key] for key in expected} == pytest.approx(expected)
    assert second["seconds"] >= first["seconds"] >= 0.0
    assert first.keys() == second.keys()


def test_newton_steps_are_counted_on_all_grids():
    progress = make_progress()
    for step in (0, 1, 2, 0, 1):
        progress(LEVEL, cycle(step))
    assert progress.steps == 3


FEW = ("129", "7.5 mm/s", "step  1", "1.5e-05", " 2 nm", "11")
ALL = ("129", "7.5 mm/s", "step  1", "1.50e-05", "-2.0e-07", "2.0000", "1.0000 nm", "11", "222")


@pytest.mark.parametrize("verbose, words", [(False, FEW), (True, ALL)])
def test_it_tells_the_speaker_of_each_cycle(verbose, words):
    speaker = Told(verbose)
    progress = make_progress(speaker)
    progress(LEVEL, cycle(0))
    progress(LEVEL, cycle(1))
    (_, _, first), (row, line, left) = speaker.told
    assert row is progress.rows[1] and first is None and left >= 0.0
    assert all(word in line for word in words), line
    assert verbose or "-2.0e-07" not in line


def test_news_are_told_once_and_before_the_cycles_that_they_lead_to():
    speaker = Told(verbose=False)
    progress = make_progress(speaker)
    other = replace(LEVEL, news="another way")
    for step, level in enumerate([LEVEL, other, other]):
        progress(level, cycle(step))
    assert [each if isinstance(each, str) else each[0]["step"] for each in speaker.told] == [
        0, "another way", 1, 2
    ]  # fmt: skip


@pytest.mark.parametrize("kind", [NEWTON, RELAXATION, DRY])
def test_a_short_line_has_eighty_columns_at_the_most(kind):
    """Of a grid of 4097 nodes with all of them counted by five digits."""
    row = {"grid": 4097, "speed_mm_s": 0.005, "step": 60, "residual": 1.2e-5, "central_film_nm": -1234.5,
           "contact_nodes": 12345, "gap_nm": 1.2e-5, "changed_nodes": 12345}  # fmt: skip
    assert 60 < len(kind.short(row)) <= 80


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
