"""Heights in ASCII as instruments exchange them: SDF  [ISO 25178-71]. Its binary form others read."""

import re

import numpy as np

from mgehl.model.surface.map import Map, SurfaceFileError
from mgehl.model.text_table import FileError, read_content, value_of

MARK = "aISO-1.0"
"""What the first line of a file says."""

NEEDED = ("numpoints", "numprofiles", "xscale", "yscale", "zscale")
"""What of the header a map is made of: points of a row, rows; the step along x and along y, and the unit of
heights, in m."""


def is_sdf(path):
    """Whether a file begins as such."""
    with open(path, "rb") as file:
        return file.read(len(MARK)) == MARK.encode()


def read_sdf(path):
    """The `Map` of a file: a header of NAME = VALUE, and between lines of an asterisk the heights of rows,
    the first at the lowest y, in lines of any length. Raises FileError."""
    header, *parts = re.split(r"^\s*\*\s*$", read_content(path), maxsplit=2, flags=re.M)
    told = dict(re.findall(r"^[ \t]*(\w+)[ \t]*=[ \t]*(\S+)", header, re.M))
    told = {name.lower(): value.replace(",", ".") for name, value in told.items()}
    try:
        columns, rows = (int(told[name]) for name in NEEDED[:2])
        dx, dy, unit = (float(told[name]) for name in NEEDED[2:])
        heights = np.array([value_of(word) for word in parts[0].split()] if parts else [], dtype=float)
    except KeyError as missing:
        raise SurfaceFileError(path, f"its header does not tell {missing.args[0]}") from None
    except ValueError as error:
        raise FileError(path, f"is no ASCII SDF: {error}") from None
    if min(columns, rows) < 1 or heights.size != columns * rows:
        size = f"{columns} x {rows}"
        raise SurfaceFileError(path, f"has {heights.size} heights; its header tells {size} of them")
    if rows == 1:
        return Map.of_profile(path, heights, dx, unit, 1.0)
    return Map(path, heights.reshape(rows, columns), dx, dy, unit, 1.0)
