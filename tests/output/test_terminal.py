import fcntl
import io
import json
import os
import pty
import struct
import termios
from math import inf, nan
from types import SimpleNamespace

import pytest
from made_solution import make_result

from mgehl.output.solution import Solution
from mgehl.output.terminal import JsonLines, Lines, Live, Quiet, line_of, speaker

ROW = {"grid": 4097, "speed_mm_s": 0.005, "step": 60, "residual": 1.2e-5, "load_error": -2e-7,
       "central_film_nm": -1234.5, "contact_nodes": 12345, "seconds": 2.0}  # fmt: skip


def said(speaker, capsys, **changes):
    with speaker:
        speaker.row(ROW, 7.0)
        bearing = SimpleNamespace(is_loaded=False)
        speaker.end(Solution(None, bearing, None, None, [], make_result(**changes)), "runs/here")
    return capsys.readouterr()


@pytest.mark.parametrize("row", [ROW, {"grid": 4097, "step": 60, "residual": 1e-5, "gap_nm": 1.2e-5,
                                       "contact_nodes": 12345, "changed_nodes": 12345}])  # fmt: skip
def test_a_line_has_eighty_columns_at_the_most_and_a_verbose_one_all(row):
    assert len(line_of(row)) <= 80 < len(line_of(ROW, verbose=True))
    assert "-2.0e-07" in line_of(ROW, verbose=True)
    assert "changed 12345" in line_of(row | {"changed_nodes": 12345}, True)


def test_a_quiet_one_says_only_that_it_failed(capsys):
    assert said(Quiet(), capsys) == ("", "")
    failed = said(Quiet(), capsys, converged=False, reason="sets cycle")
    assert failed == ("", "mgehl: not converged: sets cycle\n")


def test_json_lines(capsys):
    out, err = said(JsonLines(), capsys, residual=nan, flux_imbalance=inf)
    cycle, result = (json.loads(line, parse_constant=pytest.fail) for line in out.splitlines())
    assert cycle == {"cycle": ROW, "seconds_left": 7.0} and err == ""
    assert result["directory"] == "runs/here" and result["result"]["converged"] is True
    assert result["result"]["residual"] is None and result["result"]["flux_imbalance"] is None
    JsonLines().row({"residual": nan})
    assert json.loads(capsys.readouterr().out) == {"cycle": {"residual": None}, "seconds_left": None}
    JsonLines().news("another way")
    assert json.loads(capsys.readouterr().out) == {"news": "another way"}


class TestWhoSpeaks:
    def test_options_come_first_and_what_is_no_terminal_gets_lines(self, tmp_path):
        assert type(speaker(quiet=True)) is Quiet and type(speaker(json_lines=True)) is JsonLines
        assert type(speaker(stream=io.StringIO())) is Lines
        with (tmp_path / "log").open("w") as file:
            assert type(speaker(stream=file)) is Lines

    @pytest.mark.parametrize("columns, kind", [(80, Live), (0, Lines)])
    def test_a_terminal_that_has_a_width(self, columns, kind):
        """Open MPI's has none: what its ranks say may go to a file."""
        ours, theirs = pseudo_terminal(columns)
        with os.fdopen(ours), os.fdopen(theirs, "w") as stream:
            assert type(speaker(stream=stream)) is kind


def pseudo_terminal(columns):
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    return ours, theirs
