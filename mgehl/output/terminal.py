"""Where the words of a run go: nowhere, to plain lines, to JSON lines, or to a live terminal."""

import json
import sys
from dataclasses import asdict
from math import ceil, log

from mgehl.output.files import finite


class Silent:
    """Says nothing. The interface of the others, which are context managers, too."""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def row(self, row, line, left=None):
        """A cycle: its row of the history, its line, and the seconds that are left, if known."""

    def end(self, solution, directory):
        """The run has ended and its files are written."""


SILENT = Silent()


class Quiet(Silent):
    """Says only that a run did not converge."""

    def end(self, solution, directory):
        if not solution.result.converged:
            print(f"mgehl: not converged: {solution.result.reason}", file=sys.stderr)


class Lines(Silent):
    """A line per cycle, at last the answer and whether to trust it."""

    def row(self, row, line, left=None):
        print(line, flush=True)

    def end(self, solution, directory):
        print(solution, f"  results in {directory}", sep="\n", flush=True)


class JsonLines(Silent):
    """A JSON object per cycle and one of the result, for programs that watch."""

    def row(self, row, line, left=None):
        print(json.dumps(finite({"cycle": row, "seconds_left": left})), flush=True)

    def end(self, solution, directory):
        result = finite(asdict(solution.result))
        print(json.dumps({"result": result, "directory": str(directory)}), flush=True)


class Live(Lines):
    """Lines as ever, and under them a bar with the time that is left."""

    def __enter__(self):
        from rich.progress import BarColumn, Progress, TextColumn

        words = TextColumn("{task.description}")
        self._display = Progress(words, BarColumn(), TextColumn("{task.fields[left]}"), transient=True)
        self._task = self._display.add_task("starting", total=1.0, left="")
        self._display.start()
        return self

    def __exit__(self, *_):
        self._display.stop()

    def row(self, row, line, left=None):
        print_above = self._display.console.print
        print_above(line, highlight=False, markup=False, soft_wrap=True)
        spent = row.get("seconds", 0.0)
        done = None if left is None else spent / max(spent + left, 1e-9)
        what = f"{row['grid']} nodes, step {row['step']}"
        told = "" if left is None else f"about {ceil(left)} s left"
        self._display.update(self._task, description=what, completed=done, left=told)

    def end(self, solution, directory):
        self._display.stop()
        super().end(solution, directory)


def speaker(quiet=False, json_lines=False, stream=None):
    """The speaker that options and the terminal ask for."""
    if quiet:
        return Quiet()
    if json_lines:
        return JsonLines()
    return Live() if (stream or sys.stdout).isatty() else Lines()


STEPS_A_GRID = 8
"""Newton steps that a grid not yet begun is expected to take."""


def seconds_left(rows, finest, tolerance):
    """Guess from the history the time to the end; None where it tells nothing.

    On the present grid residuals go on falling as in the last steps; a finer one takes a few
    steps, each four times as long.
    """
    here = [row for row in rows if row["grid"] == rows[-1]["grid"]]
    if len(here) < 2:
        return None
    each = (here[-1]["seconds"] - here[0]["seconds"]) / (len(here) - 1)
    last = here[-4:]
    decades = log(last[0]["residual"] / last[-1]["residual"]) / (len(last) - 1) if _falls(last) else 0.0
    to_go = log(max(last[-1]["residual"] / tolerance, 1.0))
    steps = to_go / decades if decades > 0.0 else STEPS_A_GRID
    left, nodes = steps * each, rows[-1]["grid"]
    while nodes < finest:
        nodes, each = 2 * nodes - 1, 4.0 * each
        left += STEPS_A_GRID * each
    return left


def _falls(rows):
    """Whether the residuals are numbers and have fallen."""
    return 0.0 < rows[-1]["residual"] < rows[0]["residual"] < float("inf")
