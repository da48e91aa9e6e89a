"""Where the words of a run go: nowhere, to plain lines, to JSON lines, or to a live terminal."""

import json
import os
import sys
from contextlib import suppress
from math import ceil

from mgehl.kinds.loaded import speed_words
from mgehl.output.advice import beside_bands, what_next
from mgehl.output.files import finite, plain_result
from mgehl.saying import columns, complain, folded, say

HANGING = "    "
"""Indent of the rest of a line that is broken."""

ALMOST = 0.99
"""Part of the bar that is drawn at the most: a full one would stop its clock, while results are written."""

SHORT = {
    "time_ms": "{:9.4f} ms", "grid": "{:4d} nodes", "speed": "{:>9}", "step": "step {:2d}",
    "residual": "residual {:7.1e}",
    "gap_nm": "gap {:7.1e} nm", "central_film_nm": "film {:6.4g} nm", "contact_nodes": "contact {}",
}  # fmt: skip
"""What a line says of a cycle, of what its row in the history has: in 80 columns."""

ALL = {
    "time_ms": "{:11.6f} ms", "grid": "grid {:5d}", "speed_mm_s": "{:9.4g} mm/s", "step": "step {:2d}",
    "residual": "residual {:8.2e}", "load_error": "load {:+8.1e}", "gap_nm": "gap in contact {:8.2e} nm",
    "central_film_nm": "film {:10.4f}", "minimum_film_nm": "min {:10.4f} nm",
    "contact_nodes": "contact {:6d}", "cavitated_nodes": "cavitated {:6d}",
    "changed_nodes": "changed {:5d}", "linear_iterations": "iterations {:3d}",
    "newton_steps": "Newton {:2d}", "load_on_solids": "solids {:6.4f}",
    "e_p": "e^p {:8.2e}", "e_p_lubr": "of fluid {:8.2e}", "e_p_solid": "of solid {:8.2e}",
}  # fmt: skip
"""The same of a verbose run."""


def line_of(row, verbose=False):
    """A line about a row of the history."""
    known = row | ({"time_ms": 1e3 * row["time_s"]} if "time_s" in row else {})
    known |= {"speed": speed_words(1e-3 * row["speed_mm_s"])} if "speed_mm_s" in row else {}
    shapes = ALL if verbose else SHORT
    return "  ".join(shape.format(known[name]) for name, shape in shapes.items() if name in known)


class Silent:
    """Says nothing. The interface of the others, which are context managers, too."""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def row(self, row, left=None):
        """A cycle: its row of the history, and the seconds that are left, if known."""

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


class JsonLines(Silent):
    """A JSON object per cycle, one of the result and one of any news, for programs that watch."""

    def row(self, row, left=None):
        say(json.dumps(finite({"cycle": row, "seconds_left": left})))

    def news(self, words):
        say(json.dumps({"news": words}))

    def end(self, solution, directory):
        say(json.dumps({"result": finite(plain_result(solution.result)), "directory": str(directory)}))


class Lines(Silent):
    """A line for each cycle; at the end the answer and whether to trust it. On a terminal lines are broken
    at spaces. `verbose` ones have all numbers, however long they are."""

    def __init__(self, verbose=False):
        self._verbose = verbose

    def row(self, row, left=None):
        self._print(line_of(row, self._verbose))

    def news(self, words):
        self._print(folded(words, HANGING, columns()))

    def end(self, solution, directory):
        lines = solution.result.words(self._verbose).splitlines()
        more = *beside_bands(solution), *what_next(solution), f"results in {directory}"
        for line in *lines, *(f"  {line}" for line in more):
            self._print(folded(line, HANGING, columns()))

    def _print(self, words):
        say(words)


class Live(Lines):
    """Lines as `Lines` has them, and under them a bar with the time that is gone and left. It moves to and
    fro as long as the time left is not known.
    """

    def __enter__(self):
        from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

        told, left = TextColumn("{task.description}"), TextColumn("{task.fields[left]}")
        self._display = Progress(told, BarColumn(24), TimeElapsedColumn(), left, transient=True)
        self._task = self._display.add_task("first guess", total=None, left="")
        _safely(self._display.start)
        return self

    def __exit__(self, *_):
        _safely(self._display.stop)

    def row(self, row, left=None):
        super().row(row)
        fields = {"left": ""}
        if left is not None:
            spent = row.get("seconds", 0.0)
            done = min(spent / max(spent + left, 1e-9), ALMOST)
            fields = {"left": f"about {ceil(left)} s left", "total": 1.0, "completed": done}
        told = f"{row['grid']} nodes, step {row['step']}"
        _safely(self._display.update, self._task, description=told, **fields)

    def writing(self):
        self._display.tasks[0].total = None
        _safely(self._display.update, self._task, description="writing results", left="")

    def end(self, solution, directory):
        self.__exit__()
        super().end(solution, directory)

    def _print(self, words):
        """Put words above the bar."""
        options = {"highlight": False, "markup": False, "soft_wrap": True}
        _safely(self._display.console.print, words, **options)


def _safely(show, *words, **options):
    """A terminal may be closed."""
    with suppress(OSError, ValueError):
        show(*words, **options)


def speaker(quiet=False, json_lines=False, stream=None, verbose=False):
    """The speaker that options and the terminal ask for. Open MPI gives its ranks a terminal of their own;
    where words go to a file it has no width, and cannot show a bar."""
    if quiet or json_lines:
        return Quiet() if quiet else JsonLines()
    stream = stream or sys.stdout
    with suppress(OSError, ValueError, AttributeError):  # closed
        if stream.isatty() and os.get_terminal_size(stream.fileno()).columns > 0:
            return Live(verbose)
    return Lines(verbose)
