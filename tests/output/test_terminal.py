"""Where the words of a run go."""

import fcntl
import io
import json
import os
import pty
import re
import struct
import subprocess
import sys
import termios
from math import inf, nan

import pytest
from test_files import make_result

from mgehl.output.solution import Solution
from mgehl.output.terminal import STEPS_A_GRID, JsonLines, Lines, Live, Quiet, seconds_left, speaker

ROW = {"grid": 65, "step": 3, "residual": 1e-3, "seconds": 2.0}


def solution(**changes):
    return Solution(None, None, None, None, [], make_result(**changes))


class TestWords:
    def say(self, speaker, **changes):
        with speaker:
            speaker.row(ROW, "a line", 7.0)
            speaker.end(solution(**changes), "runs/here")

    def test_lines(self, capsys):
        self.say(Lines())
        out, err = capsys.readouterr()
        lines = out.splitlines()
        assert lines[0] == "a line" and lines[1] == "CONVERGED: all holds"
        assert lines[-1] == "  results in runs/here" and err == ""

    NEWS = " ".join(40 * ["news"])

    @pytest.mark.parametrize("kind", [Lines, Live])
    def test_news_are_broken_at_spaces(self, capsys, monkeypatch, kind):
        monkeypatch.setenv("COLUMNS", "80")
        with kind() as words:
            words.news(self.NEWS)
        out = capsys.readouterr().out
        assert out.split() == self.NEWS.split() and max(map(len, out.splitlines())) <= 80

    def test_news_as_json_and_not_at_all(self, capsys):
        JsonLines().news(self.NEWS)
        assert json.loads(capsys.readouterr().out) == {"news": self.NEWS}
        Quiet().news(self.NEWS)
        assert capsys.readouterr() == ("", "")

    def test_on_a_terminal_they_are_broken_at_spaces(self, capsys, monkeypatch):
        reason = " ".join(40 * ["sets"])
        self.say(Lines(), reason=reason)
        whole = capsys.readouterr().out
        monkeypatch.setenv("COLUMNS", "80")
        self.say(Lines(), reason=reason)
        broken = capsys.readouterr().out
        assert max(map(len, broken.splitlines())) <= 80 < max(map(len, whole.splitlines()))
        assert broken.split() == whole.split()
        assert "\n    sets " in broken

    def test_verbose_ones_have_all(self, capsys):
        self.say(Lines(verbose=True))
        verbose = capsys.readouterr().out
        self.say(Lines())
        assert "flux imbalance" in verbose and "flux imbalance" not in capsys.readouterr().out

    def test_a_quiet_one_says_nothing(self, capsys):
        self.say(Quiet())
        assert capsys.readouterr() == ("", "")

    def test_a_quiet_one_says_that_it_failed(self, capsys):
        self.say(Quiet(), converged=False, reason="sets cycle")
        assert capsys.readouterr() == ("", "mgehl: not converged: sets cycle\n")

    def test_json_lines(self, capsys):
        self.say(JsonLines(), residual=nan, flux_imbalance=inf)

        def refuse(constant):
            raise AssertionError(f"{constant} is not JSON")

        out, err = capsys.readouterr()
        cycle, result = (json.loads(line, parse_constant=refuse) for line in out.splitlines())
        assert cycle == {"cycle": ROW, "seconds_left": 7.0}
        assert result["directory"] == "runs/here" and result["result"]["converged"] is True
        assert result["result"]["residual"] is None and result["result"]["flux_imbalance"] is None
        assert err == ""

    def test_json_of_a_cycle_without_numbers(self, capsys):
        JsonLines().row(ROW | {"residual": nan}, "a line")
        assert json.loads(capsys.readouterr().out) == {
            "cycle": ROW | {"residual": None},
            "seconds_left": None,
        }


class TestWhoSpeaks:
    def test_options_come_first(self):
        assert type(speaker(quiet=True)) is Quiet
        assert type(speaker(json_lines=True)) is JsonLines

    def test_no_terminal(self, tmp_path):
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


class TestLive:
    TEXT = (
        "import sys, time\n"
        "from mgehl.errors import Stopped\n"
        "from mgehl.output.terminal import speaker\n"
        "with speaker() as words:\n"
        "    time.sleep(0.6)\n"
        "    for step in range(4):\n"
        "        words.row({'grid': 65, 'step': step, 'seconds': 1.0 + step}, f'[line] {step} ' + 99 * 'x',"
        " None if step == 0 else 6.2)\n"
        "        time.sleep(0.15)\n"
        "    words.row({'grid': 65, 'step': 4, 'seconds': 5.0}, '[line] 4', 0.0)\n"
        "    words.writing()\n"
        "    time.sleep(1.1)\n"
        "print('the end')\n"
    )

    @pytest.fixture(scope="class")
    def shown(self):
        """All that came to a terminal of 100 columns."""
        ours, theirs = pseudo_terminal(100)
        environment = os.environ | {"TERM": "xterm-256color", "COLUMNS": "100"}
        process = subprocess.Popen([sys.executable, "-c", self.TEXT], stdout=theirs, env=environment)
        os.close(theirs)
        shown = b""
        while True:
            try:
                part = os.read(ours, 65536)
            except OSError:  # all have gone
                break
            if not part:
                break
            shown += part
        os.close(ours)
        assert process.wait(timeout=60) == 0
        return shown.decode()

    def test_it_tells_grid_step_and_time_left(self, shown):
        assert "65 nodes, step 3" in shown and "about 7 s left" in shown and "0:00:00" in shown

    def test_its_bar_moves_before_anything_is_known(self, shown):
        """Frames before the first line of a cycle differ: the bar goes to and fro."""
        before = shown[: shown.index("[line]")]
        frames = [each for each in before.split("\r") if "first guess" in each]
        assert len(set(frames)) > 2
        assert "━" in shown or "╸" in shown or "-" in shown

    def test_it_goes_on_moving_while_results_are_written(self, shown):
        """With the time since the beginning, and no word of time that is left."""
        frames = [each for each in shown.split("\r") if "writing results" in each]
        assert len(set(frames)) > 2 and "left" not in "".join(frames)
        assert "0:00:01" in frames[0] and "0:00:02" in frames[-1]

    def test_lines_stay_whole_above_it(self, shown):
        plain = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", shown)
        for step in range(4):
            assert f"[line] {step} {99 * 'x'}" in plain

    def test_it_leaves_the_terminal_as_it_was(self, shown):
        assert shown.rstrip().endswith("the end")
        assert "\x1b[?25l" in shown and shown.rindex("\x1b[?25h") > shown.rindex("\x1b[?25l")
        # The bar is wiped out before the end.
        assert "\x1b[2K" in shown[shown.rindex("writing results") :]


def rows(residuals, grid=65, seconds=1.0, first=0.0):
    return [
        {"grid": grid, "step": k, "residual": residual, "seconds": first + k * seconds}
        for k, residual in enumerate(residuals)
    ]


class TestSecondsLeft:
    def test_residuals_that_fall_geometrically(self):
        """From 1e-3 to 1e-8 there are five steps at a decade each, of two seconds."""
        history = rows([1.0, 1e-1, 1e-2, 1e-3], seconds=2.0)
        assert seconds_left(history, 65, 1e-8) == pytest.approx(10.0)

    def test_an_earlier_solve_on_the_same_grid_does_not_count(self):
        """Of a walk in speed: neither its residuals nor the time in between."""
        before = rows([1.0, 1e-2, 1e-8], seconds=50.0)
        history = before + rows([1.0, 1e-1, 1e-2, 1e-3], seconds=2.0, first=300.0)
        assert seconds_left(history, 65, 1e-8) == pytest.approx(10.0)
        assert seconds_left(history[: len(before) + 1], 65, 1e-8) is None

    def test_only_the_last_steps_count(self):
        slow_at_first = rows([1.0, 0.99, 0.98, 1e-1, 1e-2, 1e-3, 1e-4])
        assert seconds_left(slow_at_first, 65, 1e-8) == pytest.approx(4.0)

    def test_nothing_is_left_once_it_is_reached(self):
        assert seconds_left(rows([1.0, 1e-9]), 65, 1e-8) == 0.0
        assert seconds_left(rows([1.0, 0.0]), 65, 1e-8) == 0.0

    def test_one_step_tells_nothing(self):
        assert seconds_left(rows([1.0]), 65, 1e-8) is None
        assert seconds_left(rows([1.0, 0.1], grid=65) + rows([1.0], grid=129), 129, 1e-8) is None

    def test_residuals_that_grow(self):
        assert seconds_left(rows([1.0, 2.0, 4.0]), 65, 1e-8) == STEPS_A_GRID

    def test_finer_grids_take_four_times_as_long_each(self):
        left = seconds_left(rows([1e-2, 1e-4, 1e-6]), 257, 1e-8)
        assert left == pytest.approx(1.0 + STEPS_A_GRID * (4.0 + 16.0))

    @pytest.mark.parametrize("residual", [nan, inf])
    def test_a_residual_that_is_no_number_tells_nothing(self, residual):
        assert seconds_left(rows([1.0, residual]), 129, 1e-8) is None

    def test_from_no_number_to_one(self):
        assert seconds_left(rows([nan, 1.0]), 65, 1e-8) == STEPS_A_GRID
