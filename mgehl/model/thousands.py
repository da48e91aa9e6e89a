"""Marks of thousands in a text table: 1,050 is 1.05 to one program and 1050 to another."""

import re
from itertools import chain

import numpy as np

FEW_COLUMNS = 8
"""Columns up to which each is a quantity of its own; more are a map of one."""

GROUPED = re.compile(r"[-+]?[1-9]\d{0,2}[.,]\d{3}")
IN_BLANKS = re.compile(r"[-+]?\d{1,3}(?:[ '\u00a0\u202f]\d{3})+(?:[.,]\d*)?")
"""1 050, which a separator has left whole."""

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
    return (
        f"line {line} has {word!r}, line {other} {number!r}: which is the decimal mark? Thousands need none"
    )


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
    """Where in a column all numbers with a mark are of thousandths, as 1.050, and others reach from 100 to
    999."""
    few = values.shape[1] <= FEW_COLUMNS
    for column in np.arange(values.shape[1])[:, None] if few else [np.arange(values.shape[1])]:
        some = np.abs(np.nan_to_num(values[:, column]))
        marked, plain = some != np.round(some), (some >= 100.0) & (some == np.round(some))
        if not marked.any() or not plain.any() or some.max() >= 1000.0 or some[marked].min() < 1.0:
            continue
        if np.abs(1e3 * some - np.round(1e3 * some)).max() > 1e-6:
            continue
        words = [words_of(text) for text in rows.values()]
        if any(re.search("[.,]", word) and not GROUPED.fullmatch(word) for word in chain(*words)):
            return None  # somewhere the mark is a decimal one for certain
        if not any(re.search("[.,]", words[row][column[k]]) for row, k in np.argwhere(plain)):
            row, k = np.argwhere(marked)[0]
            return _two_readings(list(rows)[row], words[row][column[k]])
    return None


def _two_readings(line, word):
    whole, decimal = re.sub("[.,]", "", word), word.replace(",", ".")
    return f"line {line}: {str(word)!r} may be {decimal} or {whole}: thousands need no mark"
