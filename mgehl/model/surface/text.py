"""Heights from text: a matrix of heights, or x y z of a point in each line, or x z of a profile.

Headings tell units: over the columns of x, y and z, and Gwyddion's and SPIP's, which tell sizes too. Those
of an ESRI grid tell its step and what stands for a hole.
"""

import re
from dataclasses import replace

import numpy as np

from mgehl.model.surface.map import FEWEST, UNITS, Map, SurfaceFileError, step_along
from mgehl.model.text_table import NUMBER, read_table, unit_words, value_of

SAME = 1e-4
"""Of the least step: coordinates that differ by less are one."""

APART = 4.0
"""Times the difference of two rows of heights by which a row of positions differs from the next."""

EVEN = "the first {} {} evenly spaced, as positions are, but {} taken for heights: {}?"
IS, ARE = ("is", "is", "is it"), ("are", "are", "are they")
COUNTS = "the first {} counts from 0 on: it is taken for numbers of {}s, not for heights"
"""Doubts about the first row or column of a matrix."""

MANY = 8
"""Evenly spaced heights in a row from which on they are hardly so by chance."""

NAMES = {
    axis: re.compile(rf"\W*(?:{names})(?![A-Za-z0-9=-])", re.I)
    for axis, names in {"x": "x|position|distance", "y": "y", "z": "z|height"}.items()
}
"""What columns of coordinates and heights are called."""

SIZES = "x", "y", "pixel", "dx", "dy"
"""What headings tell of a matrix."""

NO_LENGTHS = {"V", "mV", "deg", "rad", "Hz", "nA", "pA", "N", "nN"}
"""Units of what instruments map besides heights."""

_BEGIN = r"(?:^|[^\w ]) *(?:(?:scan|image|map) +)?"
"""What stands before a size: a "max height" is none."""

_STEP = rf"\b(?:dx|x[ _-](?:step|spacing|increment|pitch))\s*[:=]\s*({NUMBER})\s*([^\s;,]*)"

_TOLD = {
    "x": re.compile(rf"{_BEGIN}(?:width|breite|x-length)\s*[:=]\s*({NUMBER})\s*([^\s;]*)", re.I),
    "y": re.compile(rf"{_BEGIN}(?:height|höhe|y-length)\s*[:=]\s*({NUMBER})\s*([^\s;]*)", re.I),
    "pixel": re.compile(rf"\bpixel\s+(?:size|pitch)\s*[:=]\s*({NUMBER})\s*([^\s;]*)", re.I),
    **{f"d{axis}": re.compile(_STEP.replace("x", axis), re.I) for axis in "xy"},
    "cell": re.compile(rf"\bcellsize\s+({NUMBER})()", re.I),
    "columns": re.compile(rf"\bncols\s+({NUMBER})()", re.I),
    "rows": re.compile(rf"\bnrows\s+({NUMBER})()", re.I),
    "hole": re.compile(rf"\bnodata_value\s+({NUMBER})()", re.I),
    "factor": re.compile(rf"\bheight conversion factor \(->\s*m\)\s*=\s*({NUMBER})()", re.I),
    "unit": re.compile(r"()(?:\b(?:value|height|z)[ _-]|^\W*)units?\s*[:=]\s*([^\s;,]+)", re.I),
    "length unit": re.compile(r"()\b(?:x|xy|lateral)[ _-]units?\s*[:=]\s*([^\s;,]+)", re.I),
}
"""What headings tell: a number, a unit or both."""


def read_text(path):
    """The `Map` of a text file. Raises FileError, where there is no row of numbers NoTableError."""
    table, axes = _of_axes(read_table(path))
    told = _told(table.headings)
    columns = table.values.shape[1]
    if columns == 2:
        return _from_profile(path, table)
    if "hole" in told:
        table.values[table.values == told["hole"][0]] = np.nan
    if "cell" in told:  # a grid of maps, whose first row is the northern one
        return _checked_shape(Map(path, table.values[::-1], *(told["cell"][0],) * 2), told)
    if axes:  # which say more than a size does
        return _with_heading(_from_points(path, table), {k: v for k, v in told.items() if k not in SIZES})
    is_matrix = columns != 3 or not told.keys().isdisjoint(SIZES)
    found = _from_matrix(path, table) if is_matrix else _from_points(path, table)
    return _with_heading(found, told)


def _with_heading(found, told):
    """A `Map` with the sizes and units of its heading."""
    rows, columns = found.heights.shape
    if found.is_profile and "dx" in told:
        told["dy"] = told["dx"]
    for axis, points in (("x", columns), ("y", rows)):
        if not (step := told.get(f"d{axis}") or told.get("pixel")):
            continue
        pixels = step[0] * points, step[1]
        _check_size(found, axis, points, told.get(axis, pixels), pixels)
        told[axis] = pixels
    known = {}
    if "x" in told and "y" in told:
        (dx, unit), (dy, unit_y) = (told[axis] for axis in "xy")
        unit, unit_y = (UNITS.get(word or _unit(told, "length unit")) for word in (unit, unit_y))
        dy *= unit_y / unit if unit and unit_y else 1.0
        known = {"dx": dx / columns, "dy": dy / rows, "position_unit": unit}
    if (word := _unit(told, "unit")) in NO_LENGTHS:
        raise found.error(f"its heading tells values in {word}, which are no heights")
    unit = told["factor"][0] if "factor" in told else UNITS.get(word)
    return found.told(height_unit=unit, **known)


def _checked_shape(found, told):
    """The `Map`, where it has as many rows and columns as its heading tells."""
    for name, number in zip(("rows", "columns"), found.heights.shape, strict=True):
        if name in told and told[name][0] != number:
            raise found.error(f"its heading tells {told[name][0]:g} {name}, but it has {number}")
    return found


def _check_size(found, axis, points, told, pixels):
    """Raise SurfaceFileError where a heading tells another size than its pixels have: by more than two of
    them, and a per cent."""
    if told[1] not in UNITS or pixels[1] not in UNITS:
        return
    size, theirs = (number * UNITS[unit] for number, unit in (told, pixels))
    if abs(size - theirs) > max(2.0 / points, 0.01) * theirs:
        raise found.error(
            f"its heading tells a size along {axis} of {size:.4g} m, but its pixels make {theirs:.4g} m"
        )


def _unit(told, name):
    return told[name][1] if name in told else None


def _told(headings):
    """What headings tell, the first of each: {name: (number, unit)}."""
    told = {}
    for line in headings:
        for name, pattern in _TOLD.items():
            if name not in told and (match := pattern.search(line)):
                number, unit = match.groups()
                told[name] = value_of(number) if number else None, unit
    return told


def _from_matrix(path, table):
    """The `Map` of a matrix: a first row and column that are certainly positions are no heights."""
    if 1 in table.values.shape:
        return Map.of_profile(path, table.values.ravel())
    rows = table.values if table.top is None else np.vstack([table.top, table.values])
    x, y, z = rows[0, 1:], rows[1:, 0], rows[1:, 1:]
    if min(z.shape) < FEWEST or not (rows[0, 0] == 0.0 or np.isnan(rows[0, 0])):
        return _without_numbers(path, table.values)
    numbered = np.isnan(rows[0, 0]) and all(np.array_equal(each, np.arange(each.size)) for each in (x, y))
    if _step(path, y[::-1]):
        y, z = y[::-1], z[::-1]
    steps, are_apart = (_step(path, x), _step(path, y)), _is_apart(rows) and _is_apart(rows.T)
    if all(steps) and (table.top is not None or are_apart or numbered):
        return Map(path, z, *steps)
    if all(_is_even(path, values) for values in (x, y)):
        return Map(path, table.values, doubt=EVEN.format("row and column", *ARE))
    return _without_numbers(path, table.values)


def _without_numbers(path, z):
    """The `Map` of a matrix without a first row or column that counts; in doubt where one is even."""
    if min(z.shape) <= FEWEST:
        return Map(path, z)
    counts = [_counts(path, lines) for lines in (z, z.T)]
    z = z[int(counts[0]) :, int(counts[1]) :]
    of_both = ("row", "column"), ("column", "row")
    told = [COUNTS.format(*names) for names, found in zip(of_both, counts, strict=True) if found]
    even = [name for name, lines in (("row", z), ("column", z.T)) if _stands_apart(path, lines)]
    told += [EVEN.format(" and ".join(even), *(IS if len(even) == 1 else ARE))] if even else []
    return Map(path, z, doubt="; ".join(told))


def _counts(path, lines):
    """Whether the first of some lines has the numbers 0, 1, 2 and so on, and the next one has not."""
    many = lines.shape[1] > MANY
    return many and np.array_equal(lines[0], np.arange(lines.shape[1])) and not _is_even(path, lines[1])


def _stands_apart(path, lines):
    """Whether the first of some lines is evenly spaced, but for a corner, and the next one is not."""
    return lines.shape[1] > MANY and _is_even(path, lines[0, 1:]) and not _is_even(path, lines[1, 1:])


def _is_even(path, values):
    """Whether values rise or fall evenly."""
    return bool(_step(path, values) or _step(path, values[::-1]))


def _step(path, values):
    """The step of values that rise evenly; None of others."""
    try:
        return step_along(path, "", values, rounding(values)) if np.isfinite(values).all() else None
    except SurfaceFileError:
        return None


def _is_apart(rows):
    """Whether the first row differs from the next by far more than this one from the one after it."""
    first, others = np.abs(rows[0, 1:] - rows[1, 1:]), np.abs(np.diff(rows[1:3, 1:], axis=0))
    return np.median(first) > APART * np.median(others)


def _from_points(path, table):
    """The `Map` of points (n, 3) of a rectangle, in any order; those that are missing are holes."""
    lines, units, table = table.lines, _units(table.heading), table.values
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
    dx, dy = (step_along(path, axis, line, rounding(line)) for axis, line in (("x", x), ("y", y)))
    unit, unit_y, height_unit = units
    dy *= unit_y / unit if unit and unit_y else 1.0
    return Map(path, heights, dx, dy, height_unit, unit)


def _of_axes(table):
    """The table's columns of x and z, or of x, y and z, in this order, by the names over them, and these;
    all of it and none where there are no such names, or two alike."""
    cells = table.heading or ()
    named = [next((axis for axis, name in NAMES.items() if name.match(cell)), None) for cell in cells]
    axes = [axis for axis in NAMES if axis in named]
    if "z" not in axes or len(axes) < 2 or any(named.count(axis) > 1 for axis in axes):
        return table, axes[:0]
    if len(axes) == 2 < len(cells) and not any(_units(cells, len(cells))):
        return table, axes[:0]  # words of a comment
    columns = [named.index(axis) for axis in axes]
    return replace(table, values=table.values[:, columns], heading=[cells[k] for k in columns]), axes


def _from_profile(path, table):
    """The `Map` of x z of points along a line, in any order."""
    (x, z), (unit, height_unit) = table.values.T, _units(table.heading, 2)
    if not np.isfinite(x).all():
        raise SurfaceFileError(path, f"line {table.lines[int(np.argmin(np.isfinite(x)))]}: x is no number")
    order = np.argsort(x)
    x, z = x[order], z[order]
    if len(x) < FEWEST:
        raise SurfaceFileError(path, f"has {len(x)} points along a line; must be at least {FEWEST}")
    return Map.of_profile(path, z, step_along(path, "x", x, rounding(x)), height_unit, unit)


def _units(heading, columns=3):
    """Units in m of the columns x, y and z by the words over them; None of one that tells none."""
    if heading is None:
        return (None,) * columns
    return tuple(
        next((UNITS[w] for w in unit_words(cell) if w in UNITS and w != cell), None) for cell in heading
    )


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
