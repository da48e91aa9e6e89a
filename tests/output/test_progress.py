"""What a run says."""

import json
from dataclasses import replace
from types import SimpleNamespace

import pytest
from test_files import make_result

from mgehl.output.progress import NEWTON, Progress, trust_block
from mgehl.output.result import ContactResult, InequalityResult, Resolution
from mgehl.output.terminal import SILENT, Silent
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

    def row(self, row, line, left=None):
        self.told.append((row, line, left))


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


def test_it_tells_the_speaker_of_each_cycle():
    speaker = Told()
    progress = make_progress(speaker)
    progress(LEVEL, cycle(0))
    progress(LEVEL, cycle(1))
    (_, _, first), (row, line, left) = speaker.told
    assert row is progress.rows[1] and first is None and left >= 0.0
    for word in ("129", "7.5 mm/s", "step  1", "1.50e-05", "-2.0e-07", "2.0000", "1.0000 nm", "11", "222"):
        assert word in line


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


class TestTrustBlock:
    def test_the_answer_and_what_it_rests_on(self):
        lines = trust_block(make_result()).splitlines()
        assert lines[0] == "CONVERGED: all holds"
        text = "\n".join(lines)
        for part in ("12.0000 nm", "1.0000 nm", "2.3000 GPa", "1.0e-09", "-1.0e-10", "3 nodes", "1.00 %",
                     "4..6", "none", "5.00 cells", "80.5", "14 steps", "1 ranks"):  # fmt: skip
            assert part in text

    def test_failure_comes_first(self):
        text = trust_block(make_result(converged=False, settled=False, reason="sets still change 60 steps"))
        assert text.startswith("NOT CONVERGED: sets still change 60 steps")

    def test_a_solution_that_breaks_eq_2_is_called_both(self):
        text = trust_block(make_result(converged=False, reason="pressure below"))
        assert text.startswith("SETTLED, BUT EQ. 2 IS BROKEN: pressure below")

    def test_a_node_that_can_be_neither_is_named_with_both_reasons(self):
        node = {
            "i": 7, "j": 9, "film_gap_nm": -0.6, "contact_pressure": -0.014,
            "neighbours": ["lubricated", "cavitated", "lubricated", "contact"],
        }  # fmt: skip
        text = trust_block(make_result(converged=False, settled=False, contradictions=[node]))
        assert "node (7, 9): as film its gap is -6.00e-01 nm, as contact its pressure -1.40e-02 p_h" in text
        assert "lubricated, cavitated, lubricated, contact" in text

    def test_a_violation_is_named_with_place_and_size(self):
        assert "(6, 3) by 2.50e-01 p_h" in trust_block(make_result())

    def test_a_long_list_is_cut_and_says_so(self):
        nodes = [{"i": k, "j": 1, "size": 0.1} for k in range(1, 51)]
        result = make_result(pressure_inequality=InequalityResult(60, 50, 0.1, 1.2, nodes))
        text = trust_block(result)
        assert text.count("Eq. 2 violated at node") == 20
        assert "30 more" in text

    @pytest.mark.parametrize(
        "verdict, advice", [("coarse", "expect the film to change"), ("grid-determined", "the grid's")]
    )
    def test_a_coarse_inlet_is_a_warning(self, verdict, advice):
        assert advice in trust_block(make_result(resolution=Resolution(0.5, verdict)))

    def test_no_contact(self):
        nothing = replace(make_result(), contact=ContactResult(0, 0.0, 0.0, None, None, 0.0))
        assert "nodes none on Y = 0, none on X = 0" in trust_block(nothing)
