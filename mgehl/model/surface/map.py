"""Heights on a rectangle of equally spaced points, as a file has them."""

from dataclasses import dataclass, replace
from math import isclose

import numpy as np

from mgehl.model.text_table import FileError

FEWEST = 4
"""Points along a side: a cubic has four coefficients."""

UNEVEN = 1e-3
"""Of a step, by which it may differ from the others."""

UNITS = {
    "m": 1.0, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6, "nm": 1e-9, "A": 1e-10, "Å": 1e-10,
    "pm": 1e-12, "in": 25.4e-3, "inch": 25.4e-3, "uin": 25.4e-9, "µin": 25.4e-9, "μin": 25.4e-9,
}  # fmt: skip
"""Lengths in m, as files and configurations name them."""


class SurfaceFileError(FileError):
    """What is wrong with a file of heights."""


@dataclass(frozen=True, eq=False)
class Map:
    """Heights (ny, nx), rows along x, the first at the lowest y, in the file's units. What the file does
    not tell is None; a height that is not finite is a hole."""

    path: str
    heights: np.ndarray
    dx: float | None = None
    """Distance of the points of a row, in units of position."""
    dy: float | None = None
    height_unit: float | None = None
    """In m."""
    position_unit: float | None = None
    doubt: str = ""
    """What of the file may be misread, in words."""
    is_profile: bool = False
    """Whether the file has one row alone, of which all are copies."""

    @classmethod
    def of_profile(cls, path, heights, dx=None, height_unit=None, position_unit=None):
        """That of the heights along a line, (nx,): the same all along y."""
        rows = np.tile(heights, (FEWEST, 1))
        return cls(path, rows, dx, dx, height_unit, position_unit, is_profile=True)

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
        return self

    def told(self, **values):
        """Itself with those values that are not None."""
        return replace(self, **{name: value for name, value in values.items() if value is not None})

    def with_units(self, height_unit, position_unit, dx, dy):
        """Itself with units in m and spacing in m, where they are given: not against its own."""
        for name, given in (("height_unit", height_unit), ("position_unit", position_unit)):
            own = getattr(self, name)
            if given and own and not isclose(given, own):
                raise self.error(f'{name} = "{_called(given)}", but the file itself says "{_called(own)}"')
        for name, given, own in (("spacing", dx, self.dx), ("spacing_y", dy, self.dy)):
            own = own and self.position_unit and own * self.position_unit
            if given and own and not isclose(given, own, rel_tol=UNEVEN):
                raise self.error(f"{name} = {given:.6g} m, but the file itself says {own:.6g}")
        if not dx:
            return self.told(height_unit=height_unit, position_unit=position_unit)
        # Positions without a unit tell how wide a cell is for its length.
        wide = self.dy / self.dx if self.dx and self.dy else 1.0
        return self.told(height_unit=height_unit, dx=dx, dy=dy or wide * dx, position_unit=1.0)


def _called(unit):
    return next((name for name, size in UNITS.items() if isclose(size, unit)), f"{unit:g} m")


def step_along(path, axis, values, rounding=0.0):
    """The common step of coordinates in rising order, each of which may be off by `rounding`."""
    steps = np.diff(values)
    usual = float(np.median(steps)) if len(steps) else 0.0
    if not usual > 0.0:
        raise SurfaceFileError(path, f"its size along {axis} is zero, or its {axis} do not rise")
    # Both this step and the usual one may be off at both ends. A missing line is off by a step.
    uneven = ~(np.abs(steps - usual) <= UNEVEN * usual + min(4.0 * rounding, 0.5 * usual))
    if uneven.any():
        i = int(uneven.argmax())
        raise SurfaceFileError(
            path,
            f"its spacing along {axis} is not equal: {steps[i]:.6g} from {axis} = {values[i]:.6g} to "
            f"{values[i + 1]:.6g}, {usual:.6g} elsewhere",
        )
    return float(values[-1] - values[0]) / len(steps)
