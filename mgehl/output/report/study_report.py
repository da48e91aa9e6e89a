"""The page of a study: what it is, its tables and its pictures, from the files that it wrote."""

import csv
import re
import struct
from pathlib import Path

from mgehl.errors import OutputError
from mgehl.output.files import NAMES
from mgehl.output.report.page import Cell, Page, Section, Text, picture, table
from mgehl.output.study_directory import read_record

DPI = 150
"""Of pictures of studies."""


def is_study(directory):
    """True of a directory with tables and no file of a run, whose history is a table, too."""
    directory = Path(directory)
    return any(directory.glob("*.csv")) and not any((directory / name).exists() for name in NAMES)


def study_report(directory, studies):
    """The `Page` of a study's directory; `studies` has what each study is, by name.

    Raises OutputError where a file cannot be read.
    """
    directory = Path(directory)
    record = read_record(directory)
    known = [record.name] if record else _named_by_files(directory, studies)
    what = [Text(f"Study {name}: {studies[name]}.") for name in known if name in studies]
    sections = [_tables(directory), _pictures(directory)]
    if record:
        sections.append(_origin(record))
    title = f"Study {known[0]}" if len(known) == 1 else f"Studies in {directory.resolve().name}"
    unknown = Text("Tables of a study that its files do not name.")
    introduction = Section("what", "What it is", tuple(what) or (unknown,))
    shown = (introduction, *(section for section in sections if section.blocks))
    return Page(title, f"Study in {directory.resolve().name}", shown)


def _named_by_files(directory, studies):
    """Names of studies that the directory's name ends with, or that names of its tables begin with."""
    own = [name for name in studies if directory.resolve().name in (name, f"study-{name}")]
    stems = sorted(path.stem for path in directory.glob("*.csv"))
    return own or [name for name in studies if any(stem.split("-")[0] == name for stem in stems)]


def _tables(directory):
    return Section("tables", "Tables", tuple(_table(path) for path in _in_order(directory, "*.csv")))


def _in_order(directory, pattern):
    """Files in the order of their names, in which figure_9 comes before figure_10."""
    return sorted(
        directory.glob(pattern), key=lambda path: re.sub(r"\d+", lambda n: n[0].zfill(9), path.name)
    )


def _table(path):
    try:
        with path.open(newline="") as file:
            heads, *rows = csv.reader(file, strict=True)
    except (OSError, ValueError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or "is empty or damaged"
        raise OutputError(f"{path}: cannot be read: {reason}") from None
    if any(len(row) != len(heads) for row in rows):
        raise OutputError(f"{path}: is cut off: a row has not {len(heads)} columns")
    return table(f"{path.stem} ({len(rows)} rows)", heads, rows)


def _pictures(directory):
    return Section("pictures", "Pictures", tuple(_picture(path) for path in _in_order(directory, "*.png")))


def _picture(path):
    name = path.stem.replace("_", " ").replace("-", " ")
    try:
        content = path.read_bytes()
    except OSError as error:
        raise OutputError(f"{path}: cannot be read: {error.strerror}") from None
    alt = f"Picture of the study: {name}. Its numbers are in the tables above."
    return picture(name, alt, content, "image/png", _inches(content))


def _inches(png):
    """Width and height of a PNG file, drawn with `DPI` dots to the inch; (0, 0) where it is none."""
    if len(png) < 24 or not png.startswith(b"\x89PNG"):
        return 0.0, 0.0
    width, height = struct.unpack(">II", png[16:24])
    return width / DPI, height / DPI


def _origin(record):
    grids = ", ".join(map(str, record.nodes)) or "the study's own"
    asked = {
        "grids": grids, "branches": record.branch, "settings": ", ".join(record.settings) or None,
        "cases": record.cases, "seed": record.seed, "ranks": record.ranks,
    }  # fmt: skip
    rows = [(name, str(value)) for name, value in asked.items() if value is not None]
    rows += [(name, Cell(text, "code")) for name, text in record.versions.items()]
    return Section("origin", "How it was made", (table("Options and software", ("what", "value"), rows),))
