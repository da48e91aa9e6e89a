"""Heights from text: a matrix of heights, or x y z of a point in each line.

Numbers stand between blanks, tabs, commas or semicolons; their decimal comma is read where commas do not
separate them. A line before the first numbers is a heading; Gwyddion's and SPIP's tell sizes and units.
"""

import re
from pathlib import Path

import numpy as np

from mgehl.model.surface.map import FEWEST, UNITS, Map, SurfaceFileError, step_along

COMMENTS = ("#", "%", "//")

END = "*"
"""A line that ends the heights  [ISO 25178-71]."""

HOLES = {"", "nan", "inf", "-inf", "bad", "nodata", "none", "null", "na", "n/a", "-", "--", "---", "***"}
"""Words that stand for a height that is not there."""

SAME = 1e-4
"""Of the least step: coordinates that differ by less are one."""

_NUMBER = r"[-+]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][-+]?\d+)?"
_TOLD = {
    "x": re.compile(rf"\b(?:width|breite|x-length)\s*[:=]\s*({_NUMBER})\s*([^\s;]*)", re.I),
    "y": re.compile(rf"\b(?:height|höhe|y-length)\s*[:=]\s*({_NUMBER})\s*([^\s;]*)", re.I),
    "pixel": re.compile(rf"\bpixel\s+size\s*[:=]\s*({_NUMBER})\s*([^\s;]*)", re.I),
    "factor": re.compile(rf"\bheight conversion factor \(->\s*m\)\s*=\s*({_NUMBER})()", re.I),
    "unit": re.compile(r"()\b(?:value units?|z-unit)\s*[:=]\s*([^\s;]+)", re.I),
    "length unit": re.compile(r"()\bx-unit\s*[:=]\s*([^\s;]+)", re.I),
}
"""What headings tell: a number, a unit or both."""


class NoTableError(SurfaceFileError):
    """A file that has no row of numbers: it may be no text of heights at all."""


def read_text(path):
    """The `Map` of a text file. Raises SurfaceFileError, where there is no row of numbers NoTableError."""
    told = {}
    table, lines = _table(path, told)
    if table.shape[1] == 2:
        raise SurfaceFileError(path, "is a profile along a line, two columns; must be over a rectangle")
    is_matrix = table.shape[1] != 3 or not told.keys().isdisjoint(("x", "y", "pixel"))
    found = Map(path, table) if is_matrix else _from_points(path, table, lines)
    return _with_heading(found, told)


def _with_heading(found, told):
    """A `Map` with the sizes and units of its heading."""
    rows, columns = found.heights.shape
    if "pixel" in told:
        told["x"], told["y"] = ((told["pixel"][0] * n, told["pixel"][1]) for n in (columns, rows))
    known = {}
    if "x" in told and "y" in told:
        (dx, unit), (dy, unit_y) = (told[axis] for axis in "xy")
        unit, unit_y = (UNITS.get(word or _unit(told, "length unit")) for word in (unit, unit_y))
        dy *= unit_y / unit if unit and unit_y else 1.0
        known = {"dx": dx / columns, "dy": dy / rows, "position_unit": unit}
    unit = told["factor"][0] if "factor" in told else UNITS.get(_unit(told, "unit"))
    return found.told(height_unit=unit, **known)


def _unit(told, name):
    return told[name][1] if name in told else None


def _table(path, told):
    """Numbers (rows, columns), and the line of the file that each row stands in; headings go to `told`."""
    rows, lines, separator, first, empty = [], [], None, None, []
    for number, line in enumerate(_text(path).splitlines(), 1):
        if not line.strip(" ") or line.strip().startswith(COMMENTS):
            _listen(line, told)
            continue
        if rows and line.strip() == END:
            break
        if not rows:
            separator = _separator(line)
            if separator is False:
                first = first or _no_row(number, line)
                empty.append((number, line))
                _listen(line, told)
                continue
            for at, holes in _leading_holes(empty, line, separator):
                rows.append(_row(path, at, holes, separator))
                lines.append(at)
        rows.append(_row(path, number, line, separator))
        lines.append(number)
    if not rows:
        raise (
            NoTableError(path, first) if first else SurfaceFileError(path, "is empty: it must hold heights")
        )
    return _rectangle(path, rows, lines), lines


def _leading_holes(empty, first, separator):
    """Those of the lines before the first row of numbers that are rows of as many holes."""
    columns = len(_words(first, separator))
    for number, line in empty:
        words = _words(line, separator)
        if columns > 1 and len(words) == columns and all(map(_is_hole, words)):
            yield number, line


def _listen(line, told):
    """Keep what a heading tells."""
    for name, pattern in _TOLD.items():
        if name not in told and (match := pattern.search(line)):
            number, unit = match.groups()
            told[name] = _value(number) if number else None, unit


def _no_row(number, line):
    """Why the first line that is no comment is no row of heights."""
    return f"has no row of numbers: line {number} is {' '.join(line.split())[:40]!r}"


def _text(path):
    """The text of a file: UTF-8, UTF-16 by its mark, else Latin 1; binary files raise NoTableError."""
    content = Path(path).read_bytes()
    encodings = ("utf-16",) if content.startswith((b"\xff\xfe", b"\xfe\xff")) else ("utf-8-sig", "latin-1")
    for encoding in encodings:
        try:
            text = content.decode(encoding).rstrip("\x1a")  # which ended a text in DOS
        except UnicodeDecodeError:
            continue
        if not re.search(r"[\x00-\x08\x0e-\x1b]", text):
            return text
    raise NoTableError(path, "is no text")


def _separator(line):
    """What separates the numbers of a first row: None for blanks; False where the line is none."""
    for separator in (";", "\t", ",", None):
        if separator is None or separator in line:
            words = _words(line, separator)
            if any(map(_is_number, words)) and all(_is_number(w) or _is_hole(w) for w in words):
                return separator
    return False


def _words(line, separator):
    """What stands between separators."""
    return [word.strip() for word in re.sub(r"no data", "nodata", line, flags=re.I).split(separator)]


def _is_hole(word):
    return word.lower() in HOLES


def _is_number(word):
    return re.fullmatch(_NUMBER, word) is not None


def _row(path, line, text, separator):
    try:
        return list(map(float, (text if separator == "," else text.replace(",", ".")).split(separator)))
    except ValueError:
        words = _words(text, separator)
    for column, word in enumerate(words, 1):
        if not (_is_number(word) or _is_hole(word)):
            raise SurfaceFileError(path, f"line {line}, column {column}: {word[:40]!r} is no number")
    return list(map(_value, words))


def _value(word):
    """A number; None of an empty cell, nan of another hole."""
    if _is_hole(word):
        return np.nan if word else None
    return float(word.replace(",", "."))


def _rectangle(path, rows, lines):
    """Rows as an array. Empty cells that all rows have before or behind their numbers are none."""
    for end in (0, -1):
        while all(len(row) > 1 and row[end] is None for row in rows):
            for row in rows:
                del row[end]
    for row, line in zip(rows, lines, strict=True):
        if len(row) != len(rows[0]):
            raise SurfaceFileError(
                path, f"line {line} has {len(row)} numbers, line {lines[0]} has {len(rows[0])}"
            )
    return np.array(rows, dtype=float)


def _from_points(path, table, lines):
    """The `Map` of points (n, 3) of a rectangle, in any order; those that are missing are holes."""
    wrong = ~np.isfinite(table[:, :2])
    if wrong.any():
        row, column = np.argwhere(wrong)[0]
        raise SurfaceFileError(path, f"line {lines[row]}: {'xy'[column]} is no number")
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
    if (times > 1).any():
        j, i = np.argwhere(times > 1)[0]
        raise SurfaceFileError(path, f"x = {x[i]:.6g}, y = {y[j]:.6g} is there more than once")
    steps = (step_along(path, axis, line, rounding(line)) for axis, line in (("x", x), ("y", y)))
    return Map(path, heights, *steps)


def _coordinates(values):
    """Different values in rising order, and the index of each point's."""
    order = np.unique(values)
    steps = np.diff(order)
    least = steps[steps > SAME * np.ptp(order) / max(len(order), 1)].min(initial=np.inf)
    new = np.concatenate([[True], steps > SAME * least]) if len(order) > 1 else np.ones(1, dtype=bool)
    number = np.cumsum(new) - 1
    return order[new], number[np.searchsorted(order, values)]


def rounding(values):
    """Half of the last digit of the largest coordinate, where all have as many digits as the longest."""
    sizes = np.sort(np.abs(values))
    written = [f"{size:.14e}".split("e") for size in sizes[sizes >= 0.1 * sizes[-1]]]
    digits = max(len(number.rstrip("0")) - 1 for number, _ in written)
    return 0.5 * 10.0 ** (int(written[-1][1]) - digits + 1)
