"""A value over time, such as a speed or a load: constant, a table, or a user's own function."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from mgehl.model.own_function import OwnFunction, absolute, is_own
from mgehl.model.text_table import FileError, read_table

SAMPLES = 1001
"""Times at which a function of the user's own is asked for its largest value."""

GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)
"""Multiples of it, without their whole parts, lie evenly and have no period."""

LOOKS_IN = 3
"""Times within a step at which a function of the user's own is asked whether it goes straight on."""

RIPPLE = 0.01
"""Part of the largest value that counts as a range at the least: what was measured is never constant."""

ROUNDED = 1e-6
"""Part of a run by which a table may end before it: its times have so many digits."""

GAUSS = np.polynomial.legendre.leggauss(5)


def integral(value, begin, end):
    """That of value(t), a number or an array, between two times between which it is smooth."""
    middle, half = 0.5 * (begin + end), 0.5 * (end - begin)
    points, weights = GAUSS
    return half * sum(w * value(middle + half * x) for x, w in zip(points, weights, strict=True))


class Course:
    """SI values over time in s."""

    def value(self, t):
        """The value at a time."""
        raise NotImplementedError

    def integral(self, begin, end):
        """Its integral between two times."""
        return integral(self.value, begin, end)

    def range(self, end):
        """Its least and its largest value until a time."""
        values = [self.value(t) for t in np.linspace(0.0, end, SAMPLES)]
        return min(values), max(values)

    def kinks(self):
        """Times at which its slope changes: a step in time ends there."""
        return ()

    def bend(self, begin, end, until):
        """Largest part of its range `until` a time by which it leaves a straight line between two times."""
        return self._part(self.off(begin, end, until), until)

    def change(self, begin, end, until):
        """Part of its range `until` a time by which it changes between two times."""
        return self._part(abs(self.value(end) - self.value(begin)), until)

    def _part(self, difference, until):
        if not difference:
            return 0.0
        least, most = self.range(until)
        return float(difference / max(most - least, difference, RIPPLE * max(abs(least), abs(most))))

    def off(self, begin, end, until):
        """By how much it leaves that line."""
        return 0.0

    def stays_from(self, end):
        """Time from which it is known to stay until `end`; `end` where it is not."""
        least, most = self.range(end)
        return 0.0 if least == most else end

    def times(self, end):
        """Times from 0 to `end` between which it does not turn, as far as it is known."""
        return tuple(map(float, np.linspace(0.0, end, SAMPLES)))


@dataclass(frozen=True)
class Constant(Course):
    """The same value always."""

    constant: float

    def value(self, t):
        return self.constant

    def times(self, end):
        return 0.0, end


@dataclass(frozen=True)
class Table(Course):
    """A file of times that rise and values: straight lines between them. The values are in its second
    column, the only one besides, or where its `column` is given in that.

    `scale` takes them to s and SI units. Raises FileError where the file is none, or ends before `end`.
    """

    path: str
    scale: tuple = (1.0, 1.0)
    column: int | None = None

    @cached_property
    def _file(self):
        try:
            return read_table(self.path)
        except OSError as error:
            raise FileError(self.path, f"cannot be read: {error}") from None

    @property
    def heading(self):
        """Words over the columns; none where there are none."""
        return self._file.heading or []

    @property
    def last(self):
        """Its last time in s."""
        return float(self._columns[0][-1])

    @cached_property
    def _columns(self):
        values, lines = self._file.values, self._file.lines
        rows, columns = values.shape
        if columns != 2 and not self.column:
            raise FileError(self.path, f"must have two columns, times and values; has {columns}")
        if rows < 2:
            raise FileError(self.path, f"has {rows} rows; a table of time has two or more")
        values = values[:, [0, self.column or 1]]
        holes = np.flatnonzero(~np.isfinite(values).all(axis=1))
        if holes.size:
            raise FileError(self.path, f"line {lines[holes[0]]} has no two numbers")
        times, values = (values * self.scale).T
        back = np.flatnonzero(np.diff(times) <= 0.0)
        if back.size:
            raise FileError(self.path, _not_rising(times, lines, back[0]))
        return times, values

    def check(self, end):
        """Raise FileError unless it has values from 0 to `end`."""
        times, _ = self._columns
        if times[0] > 0.0 or times[-1] < end * (1.0 - ROUNDED):
            ends = f"goes from {times[0]:g} to {times[-1]:g} s"
            raise FileError(self.path, f"{ends}; must cover 0 to {end:g}")

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

    def stays_from(self, end):
        times = self.times(end)
        values = self.values_at(times)
        others = np.flatnonzero(values != values[-1])
        return times[others[-1] + 1] if others.size else 0.0

    def off(self, begin, end, until):
        times, values = self._columns
        within = (times > begin) & (times < end)
        straight = np.interp(times[within], [begin, end], self.values_at([begin, end]))
        return np.abs(values[within] - straight).max(initial=0.0)

    def times(self, end):
        return 0.0, *(float(t) for t in self._columns[0] if 0.0 < t < end), end


class Recorded(str):
    """The name of a user's own function where results are read: its file may be anybody's, and is not run.

    `course` is what it gave, `Samples`.
    """

    course: "Samples | None" = None

    @classmethod
    def of(cls, name, end, values):
        """That of a function that gave `values` at even times until `end`."""
        found = cls(name)
        found.course = Samples(end, tuple(values))
        return found


@dataclass(frozen=True)
class Samples(Course):
    """Values at even times until `end`, straight lines between them."""

    end: float
    values: tuple

    def check(self, end):
        """The function was asked when its run began."""

    def value(self, t):
        return float(np.interp(t, np.linspace(0.0, self.end, len(self.values)), self.values))


@dataclass(frozen=True)
class Own(Course):
    """value = FUNCTION(t) of the user's own."""

    function: OwnFunction

    @cached_property
    def _asked(self):
        """{time: (times, values) until then}."""
        return {}

    def _until(self, end):
        """Even times, and uneven ones: a wave may have a whole number of periods between even ones."""
        if end not in self._asked:
            uneven = np.modf(GOLDEN * np.arange(1, SAMPLES))[0]
            times = np.sort(np.append(np.linspace(0.0, 1.0, SAMPLES), uneven)) * end
            self._asked[end] = times, np.array([self.value(t) for t in times])
        return self._asked[end]

    def range(self, end):
        _, values = self._until(end)
        return float(values.min()), float(values.max())

    def times(self, end):
        return tuple(map(float, self._until(end)[0]))

    def check(self, end):
        """Raise OwnFunctionError unless it gives numbers from 0 to `end`."""
        self.function.check_arguments("t")
        self.range(end)

    def off(self, begin, end, until):
        times, values = self._until(until)
        within = (times > begin) & (times < end)
        few = np.linspace(begin, end, LOOKS_IN + 2)
        there = np.array([self.value(t) for t in few])
        points, found = np.append(few, times[within]), np.append(there, values[within])
        return np.abs(found - np.interp(points, [begin, end], there[[0, -1]])).max()

    def value(self, t):
        value = float(self.function.array((), t))
        if not np.isfinite(value):
            raise self.function.error(f"returns {value} at t = {t:g} s")
        return value


def course_of(value):
    """The `Course` that a key's value stands for: a number, a file's path, or FILE.py:FUNCTION."""
    if not isinstance(value, str):
        return Constant(float(value))
    if isinstance(value, Recorded):
        return value.course
    return Own(OwnFunction(value)) if is_own(value) else Table(value)


def absolute_course(value, directory="."):
    """A table's path or a function's name, counted from `directory`; None of what names neither."""
    if not isinstance(value, str):
        return None
    if isinstance(value, Recorded):
        return value
    if value.lower().endswith((".csv", ".txt")):
        return str((Path(directory) / value).resolve())
    return absolute(value, directory)


def _not_rising(times, lines, i):
    """What is wrong with the times of two rows, the first of which is `i`."""
    if times[i + 1] == times[i]:
        same = f"lines {lines[i]} and {lines[i + 1]} have the same time, {times[i]:g} s"
        return f"{same}: a jump must take some time"
    return f"its time does not rise from {times[i]:g} s on, line {lines[i]}"
