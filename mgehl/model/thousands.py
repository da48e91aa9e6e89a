"""Marks of thousands in a text table: 1,050 is 1.05 to one program and 1050 to another."""

import re
from itertools import chain

import numpy as np

FEW_COLUMNS = 8
"""Columns up to which each is a quantity of its own; more are a map of one."""

GROUPED = re.compile(r"[-+]?[1-9]\d{0,2}[.,]\d{3}")
IN_BLANKS = re.compile(r"[-+]?\d{1,3}(?:[ '\u00a0\u202f]\d{3})+(?:[.,]\d*)?")
"""1 050, which a separator has left whole."""

_DECIMAL = re.compile(r"[.,](?!\d{3}(?!\d))|(?<!\d)0[.,]|\d{4}[.,]|[eE]")
"""A mark that is none of thousands: it makes all of the file's decimal ones."""

_COMMA, _POINT = re.compile(r"[-+]?\d+,\d+"), re.compile(r"[-+]?\d+\.\d+")
_QUOTED_COMMA = re.compile(r'"\s*([-+]?\d+,\d+)\s*"')


def ambiguous(values, rows, separator, words_of):
    """What to say of numbers whose decimal mark may be one of thousands; None of others.

    `values` (rows, columns) were read from `rows`, {line: its text}, by a `separator`; `words_of(text)` has
    as many words as there are columns.
    """
    return _two_marks(rows, separator) or _quoted(rows, separator) or _grouped(values, rows, words_of)


def _two_marks(rows, separator):
    """Where some numbers have a comma and some a point. Commas that separate numbers are no marks."""
    quoted = separator == ","
    comma = _first(rows, _QUOTED_COMMA if quoted else _COMMA, '"' if quoted else ",")
    point = comma and _first(rows, _POINT, ".")
    if not point:
        return None
    (line, word), (other, number) = comma, point
    what = f"line {line} has {word!r}, line {other} {number!r}"
    return f"{what}: which is the decimal mark? Thousands need none"


def _first(rows, pattern, mark):
    found = ((line, pattern.search(text)) for line, text in rows.items() if mark in text)
    return next(((line, match[match.re.groups]) for line, match in found if match), None)


def _quoted(rows, separator):
    """Where commas separate numbers, and numbers in quotes have more of them, each before three digits."""
    if separator != "," or not (first := _first(rows, _QUOTED_COMMA, '"')):
        return None
    words = chain.from_iterable(map(_QUOTED_COMMA.findall, rows.values()))
    return _two_readings(*first) if all(map(GROUPED.fullmatch, words)) else None


def _grouped(values, rows, words_of):
    """Where no mark is a decimal one for certain, and numbers of hundreds without a mark stand beside some
    that have one and go on more smoothly with a thousand times of them."""
    if any(map(_DECIMAL.search, rows.values())):
        return None
    lines, words = list(rows), [words_of(text) for text in rows.values()]
    marked = np.array([[bool(GROUPED.fullmatch(word)) for word in row] for row in words])
    size = np.abs(np.nan_to_num(values, posinf=0.0, neginf=0.0))
    plain = (size >= 100.0) & (size < 1000.0) & ~marked
    thousandfold = np.where(marked, 1e3 * size, size)
    for column in _quantities(marked):
        some = np.ix_(np.arange(len(lines)), column)
        if not plain[some].any() or size[some][~marked[some]].max() >= 1000.0:
            continue
        if _turns(thousandfold[some]) < _turns(size[some]):
            row, place = np.argwhere(marked[some])[0]
            return _two_readings(lines[row], words[row][column[place]])
    return None


def _quantities(marked):
    """The columns of each quantity that has a mark somewhere."""
    with_marks = np.flatnonzero(marked.any(axis=0))
    return with_marks[:, None] if marked.shape[1] <= FEW_COLUMNS else [with_marks] * bool(with_marks.size)


def _turns(size):
    """How far the logarithms of numbers go up and down: down a column, of several along the rows."""
    return np.abs(np.diff(np.log1p(size), axis=int(size.shape[1] > 1))).sum()


def _two_readings(line, word):
    whole, decimal = re.sub("[.,]", "", word), word.replace(",", ".")
    return f"line {line}: {word!r} may be {decimal} or {whole}: write {whole}, or {word}0"
