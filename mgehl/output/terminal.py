"""Where the words of a run go: nowhere, to plain lines, to JSON lines, or to a live terminal."""

import json
import os
import sys
from contextlib import suppress
from math import ceil, inf, isfinite, log

from mgehl.output.advice import what_next
from mgehl.output.files import finite, plain_result
from mgehl.saying import columns, complain, folded, say

HANGING = "    "
"""Indent of the rest of a line that is broken."""
BAR = 24
"""Columns of the bar."""
ALMOST = 0.99
"""Part of the bar that is drawn at the most: a full one would stop its clock, while results are written."""


class Silent:
    """Says nothing. The interface of the others, which are context managers, too."""

    verbose = False
    """Whether lines have all numbers."""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def row(self, row, line, left=None):
        """A cycle: its row of the history, its line, and the seconds that are left, if known."""

    def news(self, words):
        """The run takes another way, in words."""

    def writing(self):
        """The last cycle is done: files and picture follow."""

    def end(self, solution, directory):
        """The run has ended and its files are written."""


SILENT = Silent()


class Quiet(Silent):
    """Says only that a run did not converge."""

    def end(self, solution, directory):
        if not solution.result.converged:
            complain(f"not converged: {solution.result.reason}")


class Lines(Silent):
    """A line for each cycle; at the end the answer and whether to trust it.

    On a terminal lines are broken at spaces. `verbose` ones have all, however long.
    """

    def __init__(self, verbose=False):
        self.verbose = verbose

    def row(self, row, line, left=None):
        say(line)

    def news(self, words):
        say(folded(words, HANGING, columns()))

    def end(self, solution, directory):
        lines = solution.result.words(self.verbose).splitlines()
        lines += [f"  {line}" for line in (*what_next(solution), f"results in {directory}")]
        width = columns()
        say(*(folded(line, HANGING, width) for line in lines), sep="\n")


class JsonLines(Silent):
    """A JSON object per cycle, one of the result and one of any news, for programs that watch."""

    def row(self, row, line, left=None):
        say(json.dumps(finite({"cycle": row, "seconds_left": left})))

    def news(self, words):
        say(json.dumps({"news": words}))

    def end(self, solution, directory):
        result = finite(plain_result(solution.result))
        say(json.dumps({"result": result, "directory": str(directory)}))


class Live(Lines):
    """Lines as `Lines` has them, and under them a bar with the time that is gone and left. It moves to and
    fro as long as the time left is not known.
    """

    def __enter__(self):
        from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

        words, left = TextColumn("{task.description}"), TextColumn("{task.fields[left]}")
        bar = BarColumn(bar_width=BAR)
        self._display = Progress(words, bar, TimeElapsedColumn(), left, transient=True)
        self._task = self._begin("first guess")
        with _AS_LONG_AS_IT_SHOWS:
            self._display.start()
        return self

    def __exit__(self, *_):
        with _AS_LONG_AS_IT_SHOWS:
            self._display.stop()

    def row(self, row, line, left=None):
        spent = row.get("seconds", 0.0)
        done = None if left is None else min(spent / max(spent + left, 1e-9), ALMOST)
        what = f"{row['grid']} nodes, step {row['step']}"
        known = {} if done is None else {"total": 1.0, "completed": done}
        told = "" if left is None else f"about {ceil(left)} s left"
        with _AS_LONG_AS_IT_SHOWS:
            self._print(line)
            self._display.update(self._task, description=what, left=told, **known)

    def news(self, words):
        with _AS_LONG_AS_IT_SHOWS:
            self._print(folded(words, HANGING, columns()))

    def _print(self, words):
        """Put words above the bar."""
        self._display.console.print(words, highlight=False, markup=False, soft_wrap=True)

    def writing(self):
        with _AS_LONG_AS_IT_SHOWS:
            before, self._task = self._task, self._begin("writing results", visible=False)
            tasks = {task.id: task for task in self._display.tasks}
            tasks[self._task].start_time = tasks[before].start_time
            self._display.remove_task(before)
            self._display.update(self._task, visible=True)

    def _begin(self, what, visible=True):
        """A bar that moves to and fro: how long it takes is not known."""
        return self._display.add_task(what, total=None, left="", visible=visible)

    def end(self, solution, directory):
        with _AS_LONG_AS_IT_SHOWS:
            self._display.stop()
        super().end(solution, directory)


_AS_LONG_AS_IT_SHOWS = suppress(OSError, ValueError)
"""A terminal may be closed."""


def speaker(quiet=False, json_lines=False, stream=None, verbose=False):
    """The speaker that options and the terminal ask for."""
    if quiet:
        return Quiet()
    if json_lines:
        return JsonLines()
    return (Live if _shows(stream or sys.stdout) else Lines)(verbose)


def _shows(stream):
    """Whether it is a terminal that can show a bar.

    Open MPI gives its ranks a terminal of their own. It has the width of that on which mpiexec was started,
    and none where the words go to a file.
    """
    try:
        return stream.isatty() and os.get_terminal_size(stream.fileno()).columns > 0
    except (OSError, ValueError, AttributeError):  # closed
        return False


STEPS_A_GRID = 8
"""Newton steps that a grid not yet begun is expected to take."""


def seconds_left(rows, finest, tolerance):
    """Guess the time to the end from the history; None where that is too short to tell.

    On the present grid residuals go on falling as in the last steps; a finer one takes a few
    steps, each four times as long. A walk in speed has more solves to come, of which nothing is known here.
    """
    here = _present_solve(rows)
    if len(here) < 2 or not isfinite(here[-1]["residual"]):
        return None
    each = (here[-1]["seconds"] - here[0]["seconds"]) / (len(here) - 1)
    left, nodes = _steps_left(here[-4:], tolerance) * each, rows[-1]["grid"]
    while nodes < finest:
        nodes, each = 2 * nodes - 1, 4.0 * each
        left += STEPS_A_GRID * each
    return left


def _present_solve(rows):
    """The last rows, of one solve on one grid: a run may solve on the finest grid several times."""
    first = len(rows) - 1
    while first > 0 and rows[first]["step"] > 0:
        first -= 1
    return rows[first:]


def _steps_left(rows, tolerance):
    """Steps until the residual is within `tolerance`, falling as it did in these rows."""
    first, last = rows[0]["residual"], rows[-1]["residual"]
    if last <= tolerance:
        return 0.0
    if not last < first < inf:
        return STEPS_A_GRID
    return log(last / tolerance) / log(first / last) * (len(rows) - 1)
