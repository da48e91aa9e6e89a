"""The page of a study: what it is, its tables and its pictures, from the files that it wrote."""

import csv
import re
import struct
from pathlib import Path

from mgehl.errors import OutputError
from mgehl.output.files import NAMES, STUDY
from mgehl.output.report.page import picture, table
from mgehl.output.study_directory import read_record

DPI = 150
"""Of pictures of studies."""


def is_study(directory):
    """True of a directory with a study's record and no file of a run."""
    return not any((directory / name).exists() for name in NAMES) and (directory / STUDY).exists()


def study_report(directory, studies):
    """The page of a study's directory, for `render`; `studies` has what each study is, by name. Raises
    OutputError where a file cannot be read."""
    directory = Path(directory)
    record, name = read_record(directory), directory.resolve().name
    return {
        "title": f"Study {record.name}",
        "subtitle": f"Study in {name}",
        "verdict": None,
        "what": [f"Study {record.name}: {studies[record.name]}."] if record.name in studies else [],
        "tables": [_table(path) for path in _in_order(directory, "*.csv")],
        "pictures": [_picture(path) for path in _in_order(directory, "*.png")],
        "origin": list(_origin(record)),
    }


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


def _picture(path):
    name = path.stem.replace("_", " ").replace("-", " ")
    try:
        content = path.read_bytes()
    except OSError as error:
        raise OutputError(f"{path}: cannot be read: {error.strerror}") from None
    dots = (0, 0)  # of a file that is no PNG
    if len(content) >= 24 and content.startswith(b"\x89PNG"):
        dots = struct.unpack(">II", content[16:24])
    return picture(name, content, "image/png", (dots[0] / DPI, dots[1] / DPI))


def _origin(record):
    """Rows of what was asked for and of the software."""
    asked = {
        "grids": ", ".join(map(str, record.nodes)) or "the study's own",
        "branches": record.branch if record.name == "transition" else None,
        "settings": ", ".join(record.settings) or None,
        "cases": record.cases, "seed": record.seed, "ranks": record.ranks,
    }  # fmt: skip
    yield from ((name, str(value)) for name, value in asked.items() if value is not None)
    yield from ((name, (text, "code")) for name, text in record.versions.items())
