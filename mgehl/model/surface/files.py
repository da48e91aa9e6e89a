"""Files of heights: numpy's, text, and what instruments write, by the library SurfaceTopography.

It reads x3p, sur, sdf, al3d, gwy, opd, vk and some thirty more, with units. `pip install mgehl[surfaces]`.
"""

import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np

from mgehl.errors import one_line
from mgehl.model.surface.map import Map, SurfaceFileError, step_along
from mgehl.model.surface.text import read_text

TEXT = ("", ".txt", ".csv", ".dat", ".asc", ".xyz", ".tsv")
"""Endings of text."""

UNITS = {
    "m": 1.0,
    "mm": 1e-3,
    "um": 1e-6,
    "µm": 1e-6,
    "μm": 1e-6,
    "nm": 1e-9,
    "A": 1e-10,
    "Å": 1e-10,
    "pm": 1e-12,
}
"""Lengths in m, as files and configurations name them."""

HEIGHTS = ("heights", "height", "z", "h")
"""Names of the matrix of an .npz file."""


def read_map(path):
    """The `Map` of a file; raises SurfaceFileError in one line for what cannot be used."""
    ending = Path(path).suffix.lower()
    try:
        if Path(path).stat().st_size == 0:
            raise SurfaceFileError(path, "is empty: it must hold heights")
        reader = {".npy": _read_npy, ".npz": _read_npz}.get(ending)
        reader = reader or (read_text if ending in TEXT else _read_instrument)
        return reader(path).checked()
    except OSError as error:
        raise SurfaceFileError(path, f"cannot be read: {error.strerror or one_line(error)}") from None


def _read_npy(path):
    return Map(path, _numbers(path, _loaded(path)))


def _read_npz(path):
    """A matrix and, where they are there, x, y, dx, dy, height_unit, position_unit and unit."""
    archive = _loaded(path)
    if not isinstance(archive, np.lib.npyio.NpzFile):
        return Map(path, _numbers(path, archive))
    with archive:
        try:
            found = {name: archive[name] for name in archive.files}
        except (ValueError, zipfile.BadZipFile, EOFError) as error:
            raise SurfaceFileError(path, f"cannot be read: {one_line(error)}") from None
    heights = _numbers(path, _heights(path, found))
    units = {name: _unit(path, found, name) for name in ("height_unit", "position_unit")}
    return Map(path, heights, **_steps(path, found, heights.shape), **units)


def _loaded(path):
    try:
        return np.load(path, allow_pickle=False)
    except (ValueError, EOFError, zipfile.BadZipFile) as error:
        raise SurfaceFileError(path, f"is no file of numpy's numbers: {one_line(error)}") from None


def _heights(path, found):
    for name in HEIGHTS:
        if name in found:
            return found[name]
    matrices = [name for name, array in found.items() if array.ndim == 2]
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
    given = found.get(name, found.get("unit"))
    if given is None:
        return None
    word = str(given)
    if word not in UNITS:
        raise SurfaceFileError(path, f"{name} = {word!r}: must be one of {', '.join(UNITS)}")
    return UNITS[word]


def _steps(path, found, shape):
    """dx and dy by coordinates x and y, or as they are given; None of what is not there."""
    steps = {}
    for axis, length in (("y", shape[0]), ("x", shape[-1])):
        if axis in found:
            line = np.ravel(_numbers(path, found[axis]))
            if len(line) != length:
                raise SurfaceFileError(
                    path, f"has {len(line)} values of {axis} for {length} points along {axis}"
                )
            steps[f"d{axis}"] = step_along(path, axis, line)
        elif f"d{axis}" in found:
            steps[f"d{axis}"] = float(found[f"d{axis}"])
    if len(steps) == 1:
        (name,) = steps
        raise SurfaceFileError(path, f"tells {name} alone; x and y, or dx and dy, go together")
    for name, step in steps.items():
        if not step > 0.0:
            raise SurfaceFileError(path, f"{name} = {step:g}: its size is zero")
    return steps


def _read_instrument(path):
    """What SurfaceTopography reads: heights (nx, ny), sizes and one unit of both."""
    try:
        from SurfaceTopography import read_topography
    except ImportError:
        raise SurfaceFileError(
            path, "its format needs SurfaceTopography, which is not installed (pip install mgehl[surfaces])"
        ) from None
    try:
        topography = read_topography(path)
        if topography.dim != 2:
            raise SurfaceFileError(path, "is a profile along a line; must be heights over a rectangle")
        heights = np.ma.filled(np.ma.asarray(topography.heights(), dtype=float), np.nan).T
        sizes, unit = topography.physical_sizes, topography.unit
    except SurfaceFileError:
        raise
    except OSError:
        raise
    except Exception as error:  # what a damaged file raises is anybody's guess
        raise SurfaceFileError(path, f"SurfaceTopography cannot read it: {one_line(error)}") from None
    found = Map(path, heights)
    if sizes is not None:
        points = np.array(heights.shape[::-1])
        dx, dy = np.asarray(sizes, dtype=float) / points
        found = replace(found, dx=float(dx), dy=float(dy))
    if unit in UNITS:
        found = replace(found, height_unit=UNITS[unit], position_unit=UNITS[unit])
    return found
