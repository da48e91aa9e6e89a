"""A value over time, such as a speed or a load: constant, a table, or a user's own function."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from mgehl.errors import UserError
from mgehl.model.own_function import OwnFunction, absolute, is_own

SAMPLES = 1001
"""Times at which a function of the user's own is asked for its largest value."""

GAUSS = np.polynomial.legendre.leggauss(5)


class CourseError(UserError):
    """What is wrong with a table of time, in one line."""


class Course:
    """SI values over time in s."""

    def value(self, t):
        """The value at a time."""
        raise NotImplementedError

    def integral(self, begin, end):
        """Its integral between two times."""
        middle, half = 0.5 * (begin + end), 0.5 * (end - begin)
        points, weights = GAUSS
        return half * sum(w * self.value(middle + half * x) for x, w in zip(points, weights, strict=True))

    def range(self, end):
        """Its least and its largest value until a time."""
        values = [self.value(t) for t in np.linspace(0.0, end, SAMPLES)]
        return min(values), max(values)

    def kinks(self):
        """Times at which its slope changes: a step in time ends there."""
        return ()


@dataclass(frozen=True)
class Constant(Course):
    """The same value always."""

    constant: float

    def value(self, t):
        return self.constant


@dataclass(frozen=True)
class Table(Course):
    """A file of two columns, times in s that rise and values in SI units: straight lines between them.

    A first line that is no number is a heading. Raises CourseError where it is none, or ends before `end`.
    """

    path: str

    @cached_property
    def _columns(self):
        try:
            lines = Path(self.path).read_text("utf-8-sig").replace(";", ",").replace("\t", ",").splitlines()
        except (OSError, UnicodeDecodeError) as error:
            raise CourseError(f"{self.path}: cannot be read: {error}") from None
        rows = [line.split(",") for line in lines if line.strip() and not line.lstrip().startswith("#")]
        if rows and not _is_number(rows[0][0]):
            rows = rows[1:]
        values = np.array([[_number(self.path, cell) for cell in _two(self.path, row)] for row in rows])
        if len(values) < 2:
            raise CourseError(f"{self.path}: has {len(values)} rows; a table of time has two or more")
        times = values[:, 0]
        back = np.flatnonzero(np.diff(times) <= 0.0)
        if back.size:
            raise CourseError(f"{self.path}: its time does not rise from {times[back[0]]:g} s on")
        return times, values[:, 1]

    def check(self, end):
        """Raise CourseError unless it has values from 0 to `end`."""
        times, _ = self._columns
        if times[0] > 0.0 or times[-1] < end * (1.0 - 1e-9):
            raise CourseError(
                f"{self.path}: goes from {times[0]:g} to {times[-1]:g} s; must cover 0 to {end:g}"
            )

    def value(self, t):
        return float(np.interp(t, *self._columns))

    def integral(self, begin, end):
        times, _ = self._columns
        points = np.concatenate([[begin], times[(times > begin) & (times < end)], [end]])
        values = self.values_at(points)
        return float(np.sum(0.5 * (values[1:] + values[:-1]) * np.diff(points)))

    def values_at(self, points):
        """The values at several times."""
        return np.interp(points, *self._columns)

    def range(self, end):
        times, values = self._columns
        inside = self.values_at(np.append(times[(times > 0.0) & (times < end)], [0.0, end]))
        return float(inside.min()), float(inside.max())

    def kinks(self):
        return tuple(self._columns[0])


@dataclass(frozen=True)
class Own(Course):
    """value = FUNCTION(t) of the user's own."""

    function: OwnFunction

    def check(self, end):
        """Raise OwnFunctionError unless it gives numbers from 0 to `end`."""
        self.function.check_arguments("t")
        self.range(end)

    def value(self, t):
        value = float(self.function.array((), t))
        if not np.isfinite(value):
            raise self.function.error(f"returns {value} at t = {t:g} s")
        return value


def course_of(value):
    """The `Course` that a key's value stands for: a number, a file's path, or FILE.py:FUNCTION."""
    if not isinstance(value, str):
        return Constant(float(value))
    return Own(OwnFunction(value)) if is_own(value) else Table(value)


def absolute_course(value, directory="."):
    """A table's path or a function's name, counted from `directory`; None of what names neither."""
    if not isinstance(value, str):
        return None
    if value.lower().endswith((".csv", ".txt")):
        return str((Path(directory) / value).resolve())
    return absolute(value, directory)


def _two(path, row):
    if len(row) < 2 or any(not cell.strip() for cell in row[:2]):
        raise CourseError(f"{path}: a row of it has no two numbers: {','.join(row)[:40]!r}")
    return row[:2]


def _number(path, cell):
    if not _is_number(cell):
        raise CourseError(f"{path}: {cell.strip()[:40]!r} is no number")
    return float(cell)


def _is_number(cell):
    try:
        return bool(np.isfinite(float(cell)))
    except ValueError:
        return False
