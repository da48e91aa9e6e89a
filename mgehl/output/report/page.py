"""Tables and pictures of a page, and how they become one HTML file that needs no other.

What the page says and how it looks are report.html.j2, run.html.j2, study.html.j2 and report.css beside
this module. A cell of a table is a text, or a pair of a text and a class of report.css.
"""

from base64 import b64encode
from math import isfinite

from jinja2 import Environment, PackageLoader, StrictUndefined

from mgehl.output.digits import is_number
from mgehl.version import VERSION

GOOD, DOUBTFUL, BAD = "good", "doubtful", "bad"
"""Kinds of a judgement; the page gives each a colour and a sign, the words are the judgement's own."""

LONGEST_UNBROKEN = 18
"""Characters of a text in a table that is not broken into lines."""

WIDE = 1.3
"""Width over height from which a picture is wide, and gets a line of its own."""

NO_NUMBER = "no number"
"""What a number that is nan, infinite, or null in result.json is called."""


def table(caption, columns, rows, folded=False):
    """A table for the template; a `folded` one is opened by its caption.

    Columns of nothing but numbers become numbers. What is no row, such as False, is left out; a row of one
    cell under more columns is the heading of those that follow.
    """
    cells = [[(each, "") if isinstance(each, str) else each for each in row] for row in rows if row]
    whole = [row for row in cells if len(row) == len(columns)]
    numeric = [_is_numeric([row[k][0] for row in whole]) for k in range(len(columns))]
    heads, *cells = (
        [(text, kind or ("number" if right else "short" if 0 < len(text) <= LONGEST_UNBROKEN else ""))
         for (text, kind), right in zip(row, numeric, strict=False)]
        for row in ([(name, "") for name in columns], *cells)
    )  # fmt: skip
    return {"caption": caption, "columns": heads, "rows": cells, "folded": folded}


def number(value, digits=6):
    """A number as text; one that is not finite, or that a file could not hold, as words."""
    if value is None or not isfinite(value):
        return NO_NUMBER
    return str(value) if isinstance(value, int) else f"{value + 0.0:.{digits}g}"


def picture(caption, content, media, size, name=""):
    """A picture for the template, of a file's bytes, `size` inches (width, height); `media` is "image/png"
    or so, `caption` says in words what it shows, `name` is its kind."""
    width, height = size
    inches = round(float(width), 2) if width > WIDE * height else 0.0
    uri = f"data:{media};base64,{b64encode(content).decode()}"
    return {"caption": caption, "uri": uri, "inches": inches, "name": name}


def render(page, **run):
    """A page as HTML text: its title, subtitle and verdict (a kind, words, the reason; or None), and what
    study.html.j2 shows; `run` has what run.html.j2 shows of a run."""
    environment = Environment(
        loader=PackageLoader("mgehl", "output/report"), extensions=["jinja2.ext.do"], autoescape=True,
        undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    told = {"solution": None, "contents": [], "highlights": [], "made_table": table, "version": VERSION}
    return environment.get_template("report.html.j2").render(told | run, page=page)


def _is_numeric(texts):
    """True where every text that says something is a number, and one does."""
    said = list(filter(None, texts))
    return bool(said) and all(text in ("none", NO_NUMBER) or is_number(text) for text in said)
