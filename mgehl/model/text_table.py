"""Rows of numbers in text, as other programs write them.

Numbers stand between blanks, tabs, commas or semicolons, quoted or not; their decimal comma is read where
bare commas do not separate them. A line before the first numbers is a heading.
"""

import csv
import re
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from mgehl.errors import UserError
from mgehl.model.thousands import IN_BLANKS, ambiguous

COMMENTS = ("#", "%", "//")

END = "*"
"""A line that ends the rows  [ISO 25178-71]."""

HOLES = {"", "nan", "inf", "-inf", "bad", "nodata", "none", "null", "na", "n/a", "-", "--", "---", "***"}
HOLES |= {"#n/a", "#na", "#nv", "#div/0!", "?", "nan(ind)", "-nan", "-nan(ind)"}
"""Words that stand for a number that is not there, besides those of Microsoft's C, such as 1.#QNAN."""

SEPARATORS = ";", "\t", ",", None
"""None: blanks."""

NUMBER = r"[-+]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][-+]?\d+)?"
_DECIMAL_COMMA = r"[-+]?\d+,\d+(?:[eE][-+]?\d+)?"
COMMA_AND_BLANK = ", "
"""Between numbers with decimal commas: 0,29, 0,31."""

UNIT_ALONE = re.compile(
    r"[\[(]?(?:[kmunpµ\u03bc]?[msN]|cm|min|[uµ\u03bc]?in|inch|deg|°|-|k?N/m?m|[kmcunµ\u03bc]?m/[sh])[\])]?"
)
"""A cell of a line of units below that of names."""

_LIKE_A_NUMBER = r"[-+]?\d[\d.,' ]*"
"""Of digits, but maybe no number: 1,234.56."""


class FileError(UserError):
    """What is wrong with a file, in one line: it begins with the file's name."""

    def __init__(self, path, what):
        super().__init__(f"{path}: {what}")
        self.path, self.what = path, what

    def __reduce__(self):
        return type(self), (self.path, self.what)  # it may go from rank to rank


class NoTableError(FileError):
    """A file that has no row of numbers: it may be no table at all."""


@dataclass(frozen=True, eq=False)
class TextTable:
    """The rows of a text file."""

    values: np.ndarray
    """(rows, columns); nan is a hole."""
    lines: list
    """Of the file, in which each row stands, from 1."""
    headings: list
    """Comments, and what stands before the first row."""
    heading: list | None
    """Words over each of the columns; None where no heading has as many."""
    top: list | None
    """A heading that is all numbers but its first word, for which nan stands."""


def read_table(path):
    """The `TextTable` of a file. Raises OSError, FileError; NoTableError where it has no row of numbers."""
    rows, lines, separator, empty, headings, above = [], [], None, [], [], []
    text = read_content(path).splitlines()
    for number, line in enumerate(text, 1):
        if not line.strip(" ") or _is_comment(line):
            headings += [line.strip().lstrip("#%/ ")] if line.strip() else []
            continue
        if rows and line.strip() == END:
            break
        if not rows:
            separator = _separator(line)
            if not separator and (column := _in_blanks(line)):
                raise _no_number(path, number, *column)
            if separator is False:
                empty.append((number, line))
                headings.append(line)
                continue
            above = list(headings)
            for at, holes in _leading_holes(path, empty, line, separator):
                rows.append(_row(path, at, holes, separator))
                lines.append(at)
        rows.append(_row(path, number, line, separator))
        lines.append(number)
    if not rows:
        raise _no_rows(path, empty)
    values, before = _rectangle(path, rows, lines)
    columns = values.shape[1]
    of_rows = {line: text[line - 1] for line in lines}
    if what := ambiguous(values, of_rows, separator, partial(_row_words, separator, before, columns)):
        raise FileError(path, what)
    return TextTable(
        values, lines, headings, _heading(above, columns, separator), _top(above, columns, separator)
    )


def unit_words(heading):
    """What in a column's heading may be its unit, the likeliest first: `t [ms]`, `t / ms`, `t ms`, `t_ms`,
    `v_mm_s` (mm/s), `ms`."""
    if found := re.search(r"[\[({<]\s*([^\])}>]*?)\s*[\])}>]\s*$", heading):
        return [found[1]]
    words, parts = heading.split(), re.split(r"[_.:-]", heading)
    tails = ("/".join(parts[k:]) for k in range(1, len(parts)))
    tails = heading.split("/", 1)[1:], words[-1:], [" ".join(words[1:])], tails
    return [heading, *(tail.strip() for each in tails for tail in each if tail.strip())]


def value_of(word):
    """A number; None of an empty cell, nan of another hole."""
    if _is_hole(word):
        return np.nan if word else None
    return float(word.replace(",", "."))


def _heading(above, columns, separator):
    """Words of the last heading that has as many as there are columns."""
    units = None
    for line in reversed(above):
        in_brackets = re.findall(r"[^\[(]+[\[(][^\])]*[\])]", line)
        for cells in (*(_words(line, each) for each in (separator, ";", "\t", ",")), in_brackets):
            while cells and not cells[-1]:
                cells.pop()
            if len(cells) != columns:
                continue
            if units:
                return [f"{cell} [{unit}]" for cell, unit in zip(cells, units, strict=True)]
            if not all(map(UNIT_ALONE.fullmatch, cells)):
                return cells
            units = [cell.strip("[]()") for cell in cells]
            break
    return units and [f"[{unit}]" for unit in units]


def _top(above, columns, separator):
    first, *others = (above and _words(above[-1], separator)) or [""]
    if len(others) + 1 != columns or not others or not all(map(_is_number, others)):
        return None
    return [np.nan, *map(value_of, others)]


def _is_comment(line):
    """Whether a line is one; #N/A begins none."""
    line = line.lstrip()
    return line.startswith(COMMENTS) and not _is_hole(re.split(r"[;,\s]", line, maxsplit=1)[0])


def _leading_holes(path, empty, first, separator):
    """Those of the lines before the first row of numbers that are rows of as many holes. Raises FileError
    where one is a row of numbers that are not understood."""
    columns = len(_words(first, separator))
    for number, line in empty:
        words = _words(line, separator)
        if columns > 1 and len(words) == columns:
            if column := _odd(words):
                raise _no_number(path, number, column, words)
            if all(map(_is_hole, words)):
                yield number, line


def _odd(words):
    """Column of the first word that is no number where all are of digits; 0 of other words."""
    known = [_is_number(word) or _is_hole(word) for word in words]
    like = all(ok or re.fullmatch(_LIKE_A_NUMBER, word) for ok, word in zip(known, words, strict=True))
    return known.index(False) + 1 if len(words) > 1 and like and not all(known) else 0


def _no_rows(path, empty):
    """Why no line that is no comment is a row of numbers."""
    for number, line in empty:
        for words in (_words(line, separator) for separator in SEPARATORS):
            if column := _odd(words):
                return _no_number(path, number, column, words)
    if not empty:
        return FileError(path, "is empty: it must hold numbers")
    number, words = _nearest(empty)
    if others := [word for word in words if not (_is_number(word) or _is_hole(word))]:
        return NoTableError(path, f"has no row of numbers: {others[0][:40]!r} in line {number} is none")
    number, line = empty[0]
    return NoTableError(path, f"has no row of numbers: line {number} is {' '.join(line.split())[:40]!r}")


def _nearest(lines):
    """(Number of the line, words) of the line with most numbers; no words where none has two."""
    split = [(number, _words(line, separator)) for number, line in lines for separator in SEPARATORS]
    found = max(split, key=lambda each: sum(map(_is_number, each[1])))
    return found if sum(map(_is_number, found[1])) > 1 else (0, [])


def _no_number(path, line, column, words):
    return FileError(path, f"line {line}, column {column}: {words[column - 1][:40]!r} is no number")


def read_content(path):
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
    """What separates the numbers of a first row; False where the line is none."""
    if re.fullmatch(rf"\s*{_DECIMAL_COMMA}(?:, +{_DECIMAL_COMMA})+\s*", line):
        return COMMA_AND_BLANK
    for separator in SEPARATORS:
        if separator is None or separator in line:
            words = _words(line, separator)
            if any(map(_is_number, words)) and all(_is_number(w) or _is_hole(w) for w in words):
                return separator
    return False


def _in_blanks(line):
    """(Column, words) of a number whose thousands blanks mark, where a line is of numbers between other
    separators; None without."""
    for separator in (each for each in (";", "\t") if each in line):
        words = _words(line, separator)
        found = [IN_BLANKS.fullmatch(word) is not None for word in words]
        if any(found) and all(
            blank or _is_number(word) or _is_hole(word) for blank, word in zip(found, words, strict=True)
        ):
            return found.index(True) + 1, words
    return None


def _row_words(separator, before, columns, line):
    """The words of a row's columns, behind so many cells that are empty in all rows."""
    return _words(line, separator)[before : before + columns]


def _words(line, separator):
    """What stands between separators, without quotes."""
    line = re.sub(r"no data", "nodata", line, flags=re.I)
    if separator in (None, COMMA_AND_BLANK) or '"' not in line:
        return [word.strip() for word in line.replace('"', " ").split(separator)]
    try:
        cells = next(csv.reader([line], delimiter=separator, skipinitialspace=True))
    except csv.Error:  # a cell is longer than 131072 characters
        cells = line.split(separator)
    return [word.strip() for word in cells]


def _is_hole(word):
    return word.lower() in HOLES or re.match(r"[-+]?1\.#", word) is not None


def _is_number(word):
    return re.fullmatch(NUMBER, word) is not None


def _row(path, line, text, separator):
    try:
        if separator == COMMA_AND_BLANK:
            return [float(word.replace(",", ".")) for word in text.split(separator)]
        return list(map(float, (text if separator == "," else text.replace(",", ".")).split(separator)))
    except ValueError:
        words = _words(text, separator)
    for column, word in enumerate(words, 1):
        if not (_is_number(word) or _is_hole(word)):
            raise _no_number(path, line, column, words)
    return list(map(value_of, words))


def _rectangle(path, rows, lines):
    """Rows as an array, and how many cells are left out before it: empty ones that all rows have before or
    behind their numbers are none."""
    for end in (-1, 0):
        behind = len(rows[0])
        while all(len(row) > 1 and row[end] is None for row in rows):
            for row in rows:
                del row[end]
    for row, line in zip(rows, lines, strict=True):
        if len(row) != len(rows[0]):
            raise FileError(path, f"line {line} has {len(row)} numbers, line {lines[0]} has {len(rows[0])}")
    return np.array(rows, dtype=float), behind - len(rows[0])
