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
    """The `Map` of a file: a header of NAME = VALUE, and between asterisks heights in rows of any length,
    the first at the lowest y. Raises FileError."""
    header, _, rest = read_content(path).partition("*")
    told = {name.lower(): value for name, value in re.findall(r"(\w+)\s*=\s*(\S+)", header)}
    try:
        columns, rows = (int(told[name]) for name in NEEDED[:2])
        dx, dy, unit = (float(told[name].replace(",", ".")) for name in NEEDED[2:])
        heights = [value_of(word) for word in rest.partition("*")[0].split()]
    except KeyError as missing:
        raise SurfaceFileError(path, f"its header does not tell {missing.args[0]}") from None
    except ValueError as error:
        raise FileError(path, f"is no ASCII SDF: {error}") from None
    if len(heights) != columns * rows:
        raise SurfaceFileError(
            path, f"has {len(heights)} heights; its header tells {columns} x {rows}, {columns * rows}"
        )
    return Map(path, np.array(heights, dtype=float).reshape(rows, columns), dx, dy, unit, 1.0)
