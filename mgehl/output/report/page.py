"""A page of sections, tables and pictures, and how it becomes one HTML file that needs no other.

The page's looks are report.html.j2 and report.css beside this module, both written into the file.
"""

import re
from base64 import b64encode
from dataclasses import dataclass
from math import isfinite
from typing import ClassVar

from jinja2 import Environment, PackageLoader, StrictUndefined

from mgehl.output.whole_file import write_whole
from mgehl.version import VERSION

GOOD, DOUBTFUL, BAD = "good", "doubtful", "bad"
"""Kinds of a judgement; the page gives each a colour and a sign, the words are the judgement's own."""

LONGEST_UNBROKEN = 18
"""Characters of a text in a table that is not broken into lines."""

WIDE = 1.3
"""Width over height from which a picture is wide."""

NO_NUMBER = "not finite"
"""What a number that is nan, infinite, or null in result.json is called."""


@dataclass(frozen=True)
class Cell:
    """Text in a table; `kind` is "" or a class of report.css, such as number, code or a judgement."""

    text: str
    kind: str = ""


@dataclass(frozen=True)
class Table:
    """Rows of `Cell` under `columns`; a `folded` one is opened by its caption.

    A row of one cell under more columns is the heading of those that follow.
    """

    block: ClassVar = "table"
    caption: str
    columns: tuple
    rows: tuple
    folded: bool = False


@dataclass(frozen=True)
class Picture:
    """A picture as a data: URI; `alt` says in words what it shows.

    A wide one gets a line of its own; where the page is narrow, it scrolls.
    """

    block: ClassVar = "picture"
    caption: str
    alt: str
    uri: str
    inches: float = 0.0
    """Width of a wide one; 0 of others."""


@dataclass(frozen=True)
class Text:
    """A paragraph."""

    block: ClassVar = "text"
    text: str


@dataclass(frozen=True)
class Section:
    """A heading, its anchor, and blocks: `Table`, `Picture`, `Text`."""

    anchor: str
    heading: str
    blocks: tuple


@dataclass(frozen=True)
class Verdict:
    """The judgement on top of a page: `kind`, the judgement in words, and its reason."""

    kind: str
    words: str
    reason: str


@dataclass(frozen=True)
class Page:
    """Everything a page shows; `highlights` are pairs of a name and a number with its unit."""

    title: str
    subtitle: str
    sections: tuple
    verdict: Verdict | None = None
    highlights: tuple = ()


def table(caption, columns, rows, folded=False):
    """A `Table` of rows of text or cells; columns of nothing but numbers become numbers."""
    cells = [[each if isinstance(each, Cell) else Cell(each) for each in row] for row in rows]
    whole = [row for row in cells if len(row) == len(columns)]
    numeric = [_is_numeric([row[k] for row in whole]) for k in range(len(columns))]
    heads = _aligned([Cell(name) for name in columns], numeric)
    return Table(caption, heads, tuple(_aligned(row, numeric) for row in cells), folded)


def number(value, digits=6):
    """A number as text; one that is not finite, or that a file could not hold, as words."""
    if value is None or not isfinite(value):
        return NO_NUMBER
    if isinstance(value, int):
        return str(value)
    return f"{value + 0.0:.{digits}g}"


def picture(caption, alt, content, media, size):
    """A `Picture` of a file's bytes, `size` inches (width, height); `media` is "image/png" or so."""
    width, height = size
    wide = width if width > WIDE * height else 0.0
    return Picture(
        caption, alt, f"data:{media};base64,{b64encode(content).decode()}", round(float(wide), 2)
    )


def render(page):
    """The page as HTML text."""
    loader = PackageLoader("mgehl", "output/report")
    environment = Environment(
        loader=loader, autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    return environment.get_template("report.html.j2").render(page=page, version=VERSION)


def write_page(path, page):
    """Write the page; what was at `path` stays until all of the new file is on the disk.

    Raises OutputError if it cannot be written.
    """
    write_whole(path, render(page))


def _aligned(row, numeric):
    """The row with cells of numeric columns as numbers, others by their length."""
    return tuple(
        cell if cell.kind else Cell(cell.text, "number" if right else _text_kind(cell.text))
        for cell, right in zip(row, numeric, strict=False)
    )


def _text_kind(text):
    return "short" if 0 < len(text) <= LONGEST_UNBROKEN else ""


def _is_numeric(cells):
    """True where every cell that says something holds a number, and one does."""
    said = [cell.text for cell in cells if cell.text]
    return bool(said) and all(map(_is_number, said))


def _is_number(text):
    """True of a number, of two as in "3 of 7" or "3 to 7", and of the words for no number."""
    try:
        for part in re.split(" of | to ", text):
            float(part)
    except ValueError:
        return text in ("none", NO_NUMBER)
    return True
