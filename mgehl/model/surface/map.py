"""Heights on a rectangle of equally spaced points, as a file has them."""

from dataclasses import dataclass, replace

import numpy as np

from mgehl.errors import UserError

FEWEST = 4
"""Points along a side: a cubic has four coefficients."""

UNEVEN = 1e-3
"""Of a step, by which it may differ from the others: text has few digits."""


class SurfaceFileError(UserError):
    """What is wrong with a file of heights, in one line: it begins with the file's name."""

    def __init__(self, path, what):
        super().__init__(f"{path}: {what}")
        self.path, self.what = path, what

    def __reduce__(self):
        return SurfaceFileError, (self.path, self.what)  # it may go from rank to rank


@dataclass(frozen=True, eq=False)
class Map:
    """Heights (ny, nx), rows along x, in the file's units; what the file does not tell is None."""

    path: str
    heights: np.ndarray
    dx: float | None = None
    """Distance of the points of a row, in units of position."""
    dy: float | None = None
    height_unit: float | None = None
    """In m."""
    position_unit: float | None = None

    def error(self, what):
        """The error that says what is wrong with this file."""
        return SurfaceFileError(self.path, what)

    def checked(self):
        """Itself, where its heights are numbers on a rectangle that is large enough."""
        z = self.heights
        if z.size == 0:
            raise self.error("is empty: it must hold heights")
        if z.ndim != 2:
            raise self.error(f"its heights have the shape {z.shape}; must be a matrix, rows along x")
        if min(z.shape) < FEWEST:
            rows, columns = z.shape
            raise self.error(f"has {rows} rows and {columns} columns; must be at least {FEWEST} of each")
        holes = ~np.isfinite(z)
        if holes.any():
            row, column = np.argwhere(holes)[0]
            raise self.error(
                f"{holes.sum()} of {z.size} points are holes, the first in row {row + 1}, column "
                f"{column + 1}; fill them first"
            )
        return self

    def with_units(self, height_unit, position_unit, dx, dy):
        """Itself with units in m and spacing in m, where they are given."""
        found = self
        if dx is not None:
            found = replace(found, dx=dx, dy=dy or dx, position_unit=1.0)
        elif position_unit is not None:
            found = replace(found, position_unit=position_unit)
        return found if height_unit is None else replace(found, height_unit=height_unit)


def step_along(path, axis, values):
    """The common step of coordinates in rising order."""
    steps = np.diff(values)
    usual = float(np.median(steps)) if len(steps) else 0.0
    if not usual > 0.0:
        raise SurfaceFileError(path, f"its size along {axis} is zero, or its {axis} do not rise")
    uneven = ~(np.abs(steps - usual) <= UNEVEN * usual)
    if uneven.any():
        i = int(uneven.argmax())
        raise SurfaceFileError(
            path,
            f"its spacing along {axis} is not equal: {steps[i]:.6g} from {axis} = {values[i]:.6g} to "
            f"{values[i + 1]:.6g}, {usual:.6g} elsewhere",
        )
    return float(values[-1] - values[0]) / len(steps)
