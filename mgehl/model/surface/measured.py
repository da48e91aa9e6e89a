"""A surface from a file: prepared, put in its place and interpolated by a cubic spline."""

import os
from dataclasses import dataclass, field
from functools import cached_property, lru_cache

import numpy as np
from scipy.interpolate import RectBivariateSpline
from scipy.ndimage import gaussian_filter, map_coordinates, spline_filter

from mgehl.model.frame import direction
from mgehl.model.surface import doubts
from mgehl.model.surface.files import read_map
from mgehl.model.surface.shortest import shortest_of
from mgehl.model.surface.smoothing import deviation, lines_of
from mgehl.model.surface.surface import Surface

CONTINUATIONS = {"none": "nearest", "mirror": "mirror", "periodic": "grid-wrap"}
"""Beyond the file's edge, and what scipy calls that."""

REMOVED = {"nothing": (), "mean": (0,), "tilt": (0, 1), "curvature": (0, 1, 2)}
"""What may be taken off, and the degrees of the polynomials that it is."""

ENOUGH = 200
"""Points along a side that tell a form."""

STANDS_OUT = 4.0
"""Height of a parabola over the rms of the rest from which on it is a form."""

REFUSE, INTERPOLATE = "refuse", "interpolate"
"""What is done about holes."""


@dataclass(frozen=True)
class Preparation:
    """What is done with a file's heights before they are a surface."""

    height_unit: float | None = None
    """In m; None: the file's own."""
    position_unit: float | None = None
    dx: float | None = None
    """In m; None: the file's own."""
    dy: float | None = None
    remove: str = "nothing"
    shortest_wavelength: float | None = None
    """Cut-offs in m of Gaussian filters [ISO 16610-61]: half of such a wave is left."""
    longest_wavelength: float | None = None
    continuation: str = "none"
    holes: str = REFUSE


@dataclass(frozen=True, eq=False)
class Heights:
    """Prepared heights (ny, nx) in m, `dx` and `dy` apart in m."""

    values: np.ndarray
    dx: float
    dy: float
    points: np.ndarray
    """The same before any filter."""
    filled: int = 0
    """Holes that were filled."""
    repeated: tuple = (0, None)
    """As `doubts.repeated`, of the heights that the file has."""
    doubt: str = ""
    """As the `Map`'s."""
    is_profile: bool = False
    """As the `Map`'s."""

    @property
    def own_points(self):
        """The points of the file: of a profile one row."""
        return self.points[:1] if self.is_profile else self.points

    @cached_property
    def form_radius(self):
        """Smallest radius of the parabola that is nearest to the points, in m; inf where what is left of
        them is of its size: any rough surface has some."""
        some = self.points[tuple(slice(None, None, 1 + n // ENOUGH) for n in self.points.shape)]
        form = _form(some, REMOVED["curvature"])
        parabola = form - _form(form, REMOVED["tilt"])
        bends = [np.ptp(parabola, axis=axis).max() for axis in (1, 0)]
        if not max(bends) > STANDS_OUT * np.std(some - form):
            return np.inf
        return min(size**2 / (8.0 * max(bend, 1e-300)) for size, bend in zip(self.size, bends, strict=True))

    @property
    def size(self):
        """Distance of the outermost points along x and along y, in m."""
        ny, nx = self.values.shape
        return (nx - 1) * self.dx, (ny - 1) * self.dy

    @property
    def size_words(self):
        """The same in words."""
        length, width = self.size
        return f"{1e6 * length:.4g} um" + (" long" if self.is_profile else f" by {1e6 * width:.4g} um")

    @property
    def tilt(self):
        """Difference of height of the nearest plane from edge to edge, the larger one, in m."""
        profiles = self.values.mean(axis=0), self.values.mean(axis=1)
        return max(2.0 * abs(np.polyfit(np.linspace(-1, 1, len(z)), z, 1)[0]) for z in profiles)


@dataclass(frozen=True)
class Measured(Surface):
    """The heights of a file, which is read when they are first asked for. The file's middle lies at x, y
    and its own x axis at `angle`. Raises SurfaceFileError."""

    path: str
    preparation: Preparation = field(default_factory=Preparation)
    x: float = 0.0
    y: float = 0.0
    angle: float = 0.0

    @cached_property
    def heights(self):
        """The `Heights`."""
        try:
            changed = os.stat(self.path).st_mtime_ns
        except OSError:
            changed = None  # reading it says why
        return _prepared(self.path, self.preparation, changed)

    def height(self, x, y):
        """By a cubic spline; beyond the edge by the continuation."""
        lines = None if self.angle % 90.0 else lines_of(x, y)
        x, y = np.broadcast_arrays(x, y) if lines is None else (x, y)
        c, s = direction(self.angle)
        x, y = np.subtract(x, self.x), np.subtract(y, self.y)
        along, across = (c * x + s * y, c * y - s * x) if s else (x, y)
        return self._spline(along, across)

    def _spline(self, x, y):
        """At points from the middle in the file's axes."""
        width, length = self.heights.size
        x, y = np.broadcast_arrays(x + 0.5 * width, y + 0.5 * length)
        if self.preparation.continuation == "none":
            x, y = np.clip(x, 0.0, width), np.clip(y, 0.0, length)
            return self._inside.ev(y, x)
        points = np.array([np.ravel(y) / self.heights.dy, np.ravel(x) / self.heights.dx])
        mode = CONTINUATIONS[self.preparation.continuation]
        return map_coordinates(self._coefficients, points, order=3, mode=mode, prefilter=False).reshape(
            x.shape
        )

    @cached_property
    def _inside(self):
        found = self.heights
        y, x = (
            np.linspace(0.0, size, n) for size, n in zip(found.size[::-1], found.values.shape, strict=True)
        )
        return RectBivariateSpline(y, x, found.values)

    @cached_property
    def _coefficients(self):
        return spline_filter(self.heights.values, mode=CONTINUATIONS[self.preparation.continuation])

    def shortest(self, x, y):
        """Of the file's own points, whatever the grid."""
        found = self.heights
        return shortest_of(found.values, found.dx, found.dy)

    def reaches(self, x, y):
        """Whether points lie within the file, or it goes on beyond its edge."""
        if self.preparation.continuation != "none":
            return np.ones(np.broadcast_shapes(np.shape(x), np.shape(y)), dtype=bool)
        c, s = direction(self.angle)
        x, y = np.subtract(x, self.x), np.subtract(y, self.y)
        width, length = self.heights.size
        return (2.0 * np.abs(c * x + s * y) <= width) & (2.0 * np.abs(c * y - s * x) <= length)


@lru_cache(maxsize=4)
def _prepared(path, preparation, _changed):
    """The `Heights` of a file."""
    told = preparation
    found = read_map(path).with_units(told.height_unit, told.position_unit, told.dx, told.dy)
    if found.height_unit is None:
        raise found.error('does not tell the unit of its heights: give height_unit, such as "um"')
    if found.dx is None:
        raise found.error('does not tell how far apart its points are: give spacing, such as "0.5 um"')
    if found.position_unit is None:
        raise found.error('does not tell the unit of its positions: give position_unit, such as "um"')
    dx, dy = found.position_unit * found.dx, found.position_unit * found.dy
    if not min(dx, dy) > 0.0:
        raise found.error("its size is zero")
    holes = _checked_holes(found, told.holes)
    z = found.height_unit * found.heights
    repeated = doubts.repeated(z[:1] if found.is_profile else z)
    if holes:
        # What is filled has the form of what was measured around it: Laplace's equation knows none.
        form = _form(z, REMOVED["curvature"])
        z = form + doubts.harmonic(z - form, dx, dy)
    points = z = z - _form(z, REMOVED[told.remove])
    mode = "wrap" if told.continuation == "periodic" else "mirror"
    if told.longest_wavelength is not None:
        z = z - _low_pass(z, told.longest_wavelength, dx, dy, mode)
    if told.shortest_wavelength is not None:
        z = _low_pass(z, told.shortest_wavelength, dx, dy, mode)
    return Heights(z, dx, dy, points, holes, repeated, found.doubt, found.is_profile)


def _checked_holes(found, holes):
    """Number of a `Map`'s holes. Raises SurfaceFileError where they are too many, or not to be filled."""
    hole = ~np.isfinite(found.heights[:1] if found.is_profile else found.heights)
    count, size = int(hole.sum()), hole.size
    if not count:
        return 0
    if count > doubts.MOST_HOLES * size:
        most = f"{100.0 * doubts.MOST_HOLES:g} %"
        raise found.error(f"{count} of {size} points are holes; at most {most} of all points can be filled")
    if holes == REFUSE:
        row, column = np.argwhere(hole)[0]
        raise found.error(
            f"{count} of {size} points are holes, the first in row {row + 1}, column {column + 1}; "
            f'holes = "{INTERPOLATE}" fills them'
        )
    return count


def _form(z, degrees):
    """The polynomial of these degrees that is nearest to the heights that there are; 0 of no degree."""
    if not degrees:
        return 0.0
    y, x = (np.linspace(-1.0, 1.0, n) for n in z.shape)
    x, y = np.broadcast_arrays(x[None, :], y[:, None])
    powers = [(i, degree - i) for degree in degrees for i in range(degree + 1)]
    form = np.stack([x**i * y**j for i, j in powers], axis=-1)
    known = np.isfinite(z)
    return form @ np.linalg.lstsq(form[known], z[known], rcond=None)[0]


def _low_pass(z, wavelength, dx, dy, mode):
    sigma = deviation(wavelength) / dy, deviation(wavelength) / dx
    return gaussian_filter(z, sigma, mode=mode)
