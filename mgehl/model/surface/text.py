"""Heights from text: a matrix of heights, or x y z of a point in each line."""

import re
from pathlib import Path

import numpy as np

from mgehl.model.surface.map import FEWEST, Map, SurfaceFileError, step_along

COMMENTS = ("#", "%", "//")

SAME = 1e-4
"""Of the least step: coordinates that differ by less are one."""


def read_text(path):
    """The `Map` of a text file. Numbers stand between blanks, commas or semicolons."""
    table, lines = _table(path)
    if table.shape[1] == 3:
        return _from_points(path, table, lines)
    return Map(path, table)


def _table(path):
    """Numbers (rows, columns), and the line of the file that each row stands in."""
    rows, lines, heading = [], [], False
    for number, line in enumerate(_text(path).splitlines(), 1):
        words = _words(line)
        if not words:
            continue
        if not rows and not heading and _is_heading(words):
            heading = True
            continue
        rows.append([_number(path, number, column, word) for column, word in enumerate(words, 1)])
        lines.append(number)
        if len(rows[-1]) != len(rows[0]):
            raise SurfaceFileError(
                path,
                f"line {number} has {len(rows[-1])} numbers, line {lines[0]} has {len(rows[0])}",
            )
    if not rows:
        raise SurfaceFileError(path, "is empty: it must hold heights")
    return np.array(rows), lines


def _text(path):
    try:
        return Path(path).read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise SurfaceFileError(
            path, "is neither text nor a format that is read here; instruments' formats are read where "
            "SurfaceTopography is installed (pip install mgehl[surfaces])"
        ) from None  # fmt: skip


def _words(line):
    """What stands between blanks or one kind of separator; nothing of a comment."""
    line = line.strip()
    if not line or line.startswith(COMMENTS):
        return []
    separator = next((each for each in ";,\t" if each in line), None)
    words = [word.strip() for word in line.split(separator)]
    return words[:-1] if separator and not words[-1] else words


def _is_heading(words):
    """Names of columns, such as x y z: no word is a number, and each begins with a letter."""
    return all(re.match(r"[^\W\d]", word) and not _is_number(word) for word in words)


def _is_number(word):
    try:
        float(word)
    except ValueError:
        return False
    return True


def _number(path, line, column, word):
    if not _is_number(word):
        what = f"{word[:40]!r} is no number" if word else "is empty"
        raise SurfaceFileError(path, f"line {line}, column {column}: {what}")
    return float(word)


def _from_points(path, table, lines):
    """The `Map` of points (n, 3), in any order, that fill a rectangle."""
    wrong = ~np.isfinite(table)
    if wrong.any():
        row, column = np.argwhere(wrong)[0]
        raise SurfaceFileError(path, f"line {lines[row]}: {'xyz'[column]} is {table[row, column]}: a hole")
    x, i = _coordinates(table[:, 0])
    y, j = _coordinates(table[:, 1])
    if min(len(x), len(y)) < FEWEST or len(x) * len(y) > 4 * len(table):
        raise SurfaceFileError(
            path,
            f"has three columns, x y z of points, but these fill no rectangle: {len(table)} points with "
            f"{len(x)} different x and {len(y)} different y",
        )
    heights, times = np.full((len(y), len(x)), np.nan), np.zeros((len(y), len(x)), dtype=int)
    heights[j, i] = table[:, 2]
    np.add.at(times, (j, i), 1)
    _check_filled(path, times, x, y)
    return Map(path, heights, step_along(path, "x", x), step_along(path, "y", y))


def _coordinates(values):
    """Different values in rising order, and the index of each point's."""
    order = np.unique(values)
    steps = np.diff(order)
    least = steps[steps > SAME * np.ptp(order) / max(len(order), 1)].min(initial=np.inf)
    new = np.concatenate([[True], steps > SAME * least]) if len(order) > 1 else np.ones(1, dtype=bool)
    number = np.cumsum(new) - 1
    return order[new], number[np.searchsorted(order, values)]


def _check_filled(path, times, x, y):
    """Each point of the rectangle must be there once."""
    for wrong, what in ((times == 0, "is missing"), (times > 1, "is there more than once")):
        if wrong.any():
            j, i = np.argwhere(wrong)[0]
            raise SurfaceFileError(
                path,
                f"its x y z are no full rectangle of {len(x)} by {len(y)} points: x = {x[i]:.6g}, "
                f"y = {y[j]:.6g} {what}",
            )
