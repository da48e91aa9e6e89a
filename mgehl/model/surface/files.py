"""Files of heights: numpy's, text, and what instruments write, by the library SurfaceTopography.

It reads x3p, sur, sdf, al3d, gwy, opd, vk and some thirty more, with units. `pip install mgehl[surfaces]`.
A file is what its content says, whatever its name ends with.
"""

import sys
import zipfile
from contextlib import redirect_stdout
from math import prod
from pathlib import Path

import numpy as np
from numpy.lib import format as npy

from mgehl.errors import one_line
from mgehl.model.surface.map import UNITS, Map, SurfaceFileError, step_along
from mgehl.model.surface.sdf import is_sdf, read_sdf
from mgehl.model.surface.text import read_text
from mgehl.model.text_table import FileError, NoTableError

MOST_BYTES = 2**31
"""Of an array, unpacked."""

TEXTS = "xyz", "asc"
"""SurfaceTopography's own readers of text, which leave out lines that they do not understand."""

HEIGHTS = ("heights", "height", "z", "h")
"""Names of the matrix of an .npz file."""


def read_map(path):
    """The `Map` of a file; raises SurfaceFileError in one line for what cannot be used."""
    try:
        if Path(path).stat().st_size == 0:
            raise SurfaceFileError(path, "is empty: it must hold heights")
        if _is_numpy(path):
            return _read_numpy(path).checked()
        try:
            if is_sdf(path):
                return read_sdf(path).checked()
            return read_text(path).checked()
        except FileError as error:
            return _read_instrument(path, error).checked()
    except OSError as error:
        raise SurfaceFileError(path, f"cannot be read: {error.strerror or one_line(error)}") from None


def _is_numpy(path):
    """Whether a file is an array or an archive of arrays."""
    with open(path, "rb") as file:
        if file.read(len(npy.MAGIC_PREFIX)) == npy.MAGIC_PREFIX:
            return True
    if not zipfile.is_zipfile(path):
        return False
    with zipfile.ZipFile(path) as archive:
        return all(name.endswith(".npy") for name in archive.namelist())


def _read_numpy(path):
    """A matrix and, of an archive where they are there, x, y, dx, dy, height_unit, position_unit and unit.
    Of an archive nothing else is unpacked."""
    try:
        if not zipfile.is_zipfile(path):
            with open(path, "rb") as file:
                _check_bytes(path, "its array", file)
            heights = _numbers(path, np.load(path, allow_pickle=False))
            return _matrix_or_profile(path, heights)
        with np.load(path, allow_pickle=False) as archive:
            found = _Arrays(path, archive)
            heights = _numbers(path, _heights(path, found))
            units = {name: _unit(path, found, name) for name in ("height_unit", "position_unit")}
            return _matrix_or_profile(path, heights).told(**_steps(path, found, heights.shape), **units)
    except (ValueError, EOFError, zipfile.BadZipFile) as error:
        raise SurfaceFileError(path, f"is no file of numpy's numbers: {one_line(error)}") from None


def _matrix_or_profile(path, heights):
    """The `Map` of an array: of one row or column, or of one axis, that of a profile."""
    if _is_profile(heights.shape):
        return Map.of_profile(path, heights.ravel())
    return Map(path, heights)


def _is_profile(shape):
    return len(shape) == 1 or (len(shape) == 2 and 1 in shape)


class _Arrays:
    """The arrays of an archive, each of which is read when it is asked for, unless it is too large."""

    def __init__(self, path, archive):
        self._path, self._archive = path, archive

    def __iter__(self):
        return iter(self._archive.files)

    def __contains__(self, name):
        return name in self._archive.files

    def __getitem__(self, name):
        self.shape(name)
        return self._archive[name]

    def shape(self, name):
        """Of an array, by its head alone."""
        with self._archive.zip.open(f"{name}.npy") as member:
            return _check_bytes(self._path, f"its array {name!r}", member)


def _check_bytes(path, what, file):
    """The shape in the head of an array. Raises SurfaceFileError where the array is too large."""
    version = npy.read_magic(file)
    head = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
    shape, _, kind = head(file)
    if (size := prod(shape) * kind.itemsize) > MOST_BYTES:
        raise SurfaceFileError(path, f"{what} has {size:.3g} bytes; must be at most {MOST_BYTES:.3g}")
    return shape


def _heights(path, found):
    """The array that is called heights, or the only matrix."""
    for name in HEIGHTS:
        if name in found:
            return found[name]
    matrices = [name for name in found if len(found.shape(name)) == 2]
    if len(matrices) != 1:
        raise SurfaceFileError(
            path, f"has no array named {HEIGHTS[0]!r}; its arrays are {', '.join(found) or 'none'}"
        )
    return found[matrices[0]]


def _numbers(path, array):
    """Doubles of an array of numbers."""
    if array.dtype.kind not in "fiu":
        kind = "text" if array.dtype.kind in "US" else f"values of type {array.dtype}"
        raise SurfaceFileError(path, f"holds {kind}, not numbers")
    return np.asarray(array, dtype=float)


def _unit(path, found, name):
    """The unit of this name, or the one for all, in m."""
    given = next((each for each in (name, "unit") if each in found), None)
    if given is None:
        return None
    word = str(found[given])
    if word not in UNITS:
        raise SurfaceFileError(path, f"{name} = {word!r}: must be one of {', '.join(UNITS)}")
    return UNITS[word]


def _steps(path, found, shape):
    """dx and dy by coordinates x and y, or as they are given; nothing of what is not there. A profile has x
    alone."""
    steps, is_profile = {}, _is_profile(shape)
    for axis, length in [("x", max(shape))] if is_profile else [("y", shape[0]), ("x", shape[-1])]:
        if axis in found:
            line = np.ravel(_numbers(path, found[axis]))
            if len(line) != length:
                raise SurfaceFileError(
                    path, f"has {len(line)} values of {axis} for {length} points along {axis}"
                )
            steps[f"d{axis}"] = step_along(path, axis, line)
        elif f"d{axis}" in found:
            steps[f"d{axis}"] = float(found[f"d{axis}"])
    if is_profile and steps:
        steps["dy"] = steps["dx"]
    elif len(steps) == 1:
        (name,) = steps
        raise SurfaceFileError(path, f"tells {name} alone; x and y, or dx and dy, go together")
    for name, step in steps.items():
        if not step > 0.0:
            raise SurfaceFileError(path, f"{name} = {step:g}: its size is zero")
    return steps


def _read_instrument(path, fault):
    """What SurfaceTopography reads: heights (nx, ny), sizes and one unit of both. `fault` says why the file
    is no text of heights: so are those that the library itself reads as text."""
    no_text = isinstance(fault, NoTableError)
    try:
        from SurfaceTopography import open_topography
        from SurfaceTopography.Exceptions import CannotDetectFileFormat
    except ImportError:
        install = "instruments' formats need SurfaceTopography, which is not installed"
        more = f"; {install} (pip install mgehl[surfaces])" if no_text else ""
        raise SurfaceFileError(path, f"{fault.what}{more}") from None
    try:
        with redirect_stdout(sys.stderr), open_topography(path) as reader:  # some of its readers print
            if reader.format() in TEXTS:
                raise SurfaceFileError(path, fault.what)
            channel = reader.default_channel
            sizes, unit = channel.physical_sizes, channel.unit
            told = {} if sizes else {"physical_sizes": channel.nb_grid_pts}
            topography = reader.topography(**told)
            if not topography.is_uniform:
                raise SurfaceFileError(path, "is a profile whose points are not evenly spaced")
            found = np.ma.asarray(topography.heights(), dtype=float)
    except (SurfaceFileError, OSError):
        raise
    except CannotDetectFileFormat:
        more = ", and no format that SurfaceTopography reads" if no_text else ""
        raise SurfaceFileError(path, f"{fault.what}{more}") from None
    except Exception as error:  # what a damaged file raises is anybody's guess
        raise SurfaceFileError(path, f"SurfaceTopography cannot read it: {one_line(error)}") from None
    heights, unit = found.filled(np.nan).T, UNITS.get(unit) if isinstance(unit, str) else None
    steps = [None, None] if sizes is None else [float(step) for step in np.divide(sizes, found.shape)]
    if heights.ndim == 1:
        return Map.of_profile(path, heights, steps[0], unit, unit)
    return Map(path, heights, *steps, unit, unit)
