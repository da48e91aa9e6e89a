"""Tables and pictures of a page, and how they become one HTML file that needs no other.

What the page says and how it looks are report.html.j2, run.html.j2 and report.css beside this module.
"""

from base64 import b64encode
from dataclasses import dataclass
from math import isfinite
from typing import ClassVar

from jinja2 import Environment, PackageLoader, StrictUndefined

from mgehl.output.digits import is_number
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
    """A picture as a data: URI; `alt` says in words what it shows, `name` its kind.

    A wide one gets a line of its own; where the page is narrow, it scrolls.
    """

    block: ClassVar = "picture"
    caption: str
    alt: str
    uri: str
    inches: float = 0.0
    """Width of a wide one; 0 of others."""
    name: str = ""


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
class Page:
    """A title, a line above it, sections; a `verdict` is its kind, its words and its reason."""

    title: str
    subtitle: str
    sections: tuple = ()
    verdict: tuple | None = None


def table(caption, columns, rows, folded=False):
    """A `Table` of rows of text or cells; columns of nothing but numbers become numbers. What is no row,
    such as False, is left out.
    """
    cells = [[each if isinstance(each, Cell) else Cell(each) for each in row] for row in rows if row]
    whole = [row for row in cells if len(row) == len(columns)]
    numeric = [_is_numeric([row[k] for row in whole]) for k in range(len(columns))]
    heads = _aligned([Cell(name) for name in columns], numeric)
    return Table(caption, heads, tuple(_aligned(row, numeric) for row in cells), folded)


def number(value, digits=6):
    """A number as text; one that is not finite, or that a file could not hold, as words."""
    if value is None or not isfinite(value):
        return NO_NUMBER
    return str(value) if isinstance(value, int) else f"{value + 0.0:.{digits}g}"


def picture(caption, alt, content, media, size, name=""):
    """A `Picture` of a file's bytes, `size` inches (width, height); `media` is "image/png" or so."""
    width, height = size
    wide = round(float(width), 2) if width > WIDE * height else 0.0
    return Picture(caption, alt, f"data:{media};base64,{b64encode(content).decode()}", wide, name)


def render(page, **run):
    """The page as HTML text; `run` has what run.html.j2 shows of a run."""
    environment = Environment(
        loader=PackageLoader("mgehl", "output/report"), extensions=["jinja2.ext.do"], autoescape=True,
        undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    told = {"solution": None, "contents": [], "highlights": [], "made_table": table, "version": VERSION}
    return environment.get_template("report.html.j2").render(told | run, page=page)


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
    return bool(said) and all(text in ("none", NO_NUMBER) or is_number(text) for text in said)
