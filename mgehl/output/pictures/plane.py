"""What maps show: a part of a run's plane in mm, in blocks of nodes, and the scale of its film."""

from math import ceil

import numpy as np
from matplotlib.colors import LogNorm, Normalize

from mgehl.discretization.status import CAVITATED, CONTACT, NAMES
from mgehl.solver.verification import LOADED

MOST = 700
"""Nodes or blocks along a side that a map of its own shows: about as many as it has dots."""
OVERLAP = len(NAMES)
"""Drawn as a status: nodes outside of contact whose gap is negative."""
MARGIN = 0.5
"""Room about what a map shows, over half of it."""
INSIDE = (0.9, 1.25, np.inf)
"""Parts of the loaded zone whose films make the scale, as far as there is film: its rim is steep."""
LEAST_OPEN = 0.02
"""Part of them that must be film."""
UNIFORM, LINEAR, DECADES = 1.1, 8.0, 1e4
"""Ratios of films up to which they are one on a scale, and it is linear; the largest that it holds."""
NO_FILM = 10.0
"""Upper end of a scale of films, in nm, where there is none."""


class Blocks:
    """Equal blocks of the nodes at X (nx,) and Y (ny,), at most `most` along either side. A block is drawn
    as the least of its nodes' films, and as the largest pressure and status, contact above cavity above
    film: so single nodes in contact stay."""

    def __init__(self, X, Y, most=MOST):
        self._stride = ceil(max(len(X), len(Y)) / most)
        self.X, self.Y = (
            self._reduced(np.add, line) / self._reduced(np.add, 1.0 + 0.0 * line) for line in (X, Y)
        )
        self.extent = *self._ends(X), *self._ends(Y)
        """Left, right, lower and upper end of an image; its last blocks may reach beyond the nodes."""

    def least(self, values):
        """The least of each block's values: (ny, nx) to (len(Y), len(X))."""
        return self._reduced(np.minimum, values)

    def largest(self, values):
        """The largest of each block's values: (ny, nx) to (len(Y), len(X))."""
        return self._reduced(np.maximum, values)

    def _reduced(self, extreme, values):
        for axis in range(values.ndim):
            values = extreme.reduceat(values, np.arange(0, values.shape[axis], self._stride), axis=axis)
        return values

    def _ends(self, line):
        """Where the first block of a line of nodes begins, and where the last whole one ends."""
        cell = (line[-1] - line[0]) / (len(line) - 1) if len(line) > 1 else 1.0
        first = float(line[0]) - 0.5 * cell
        return first, first + ceil(len(line) / self._stride) * self._stride * cell


class Plane:
    """A part of a run's plane in `blocks`, in mm; fields are (len(blocks.Y), len(blocks.X)). It is what
    carries load and Hertz's ellipse, with room, or the `whole` domain. `film` is in nm, `filling` from 0 to
    1; `distance` that from the loaded zone's middle, 1 on its edge; `part` the nodes' slices (y, x)."""

    def __init__(self, solution, most=MOST, whole=False):
        contact, fields, ends = solution.contact, solution.fields, solution.at_the_end
        loaded = (fields.P > LOADED * fields.P.max()) | (fields.status == CONTACT)
        Y, y, high, rows = _place(1e3 * solution.y, 1e3 * ends.y_scale, loaded.any(axis=1), whole)
        X, x, wide, columns = _place(1e3 * solution.x, 1e3 * ends.x_scale, loaded.any(axis=0), whole)
        self.part = part = rows, columns
        self.blocks = Blocks(X, Y, most)
        overlap = (fields.H < 0.0) & (fields.status != CONTACT)
        self.status = self.blocks.largest(np.where(overlap, OVERLAP, fields.status)[part])
        self.film = self.blocks.least(1e9 * contact.film_scale * fields.H[part])
        self.filling = self.blocks.least(fields.full_part[part])
        self.distance = np.hypot((self.blocks.X - x) / wide, (self.blocks.Y[:, None] - y) / high)

    def largest(self, values):
        """The largest of a field of the run, (ny, nx), in each block."""
        return self.blocks.largest(values[self.part])


def _place(line, hertz, loaded, whole):
    """Of nodes in mm: those that are shown, middle and half of those that carry load, and the slice."""
    ends = line[loaded][[0, -1]] if loaded.sum() > 1 else np.array((-hertz, hertz))
    middle, half = ends.mean(), 0.5 * np.ptp(ends)
    room = MARGIN * half
    first, last = np.searchsorted(line, (min(ends[0], -hertz) - room, max(ends[1], hertz) + room))
    rim = int(len(line) > 2)  # the boundary's nodes: neither film nor cavity
    part = slice(None) if whole else slice(max(int(first) - 1, rim), min(int(last) + 1, len(line) - rim))
    return line[part], middle, half, part


def film_norm(plane):
    """Norm of the open film in nm, from its least on the map to the largest inside the loaded zone."""
    has_film = (plane.status < CAVITATED) & (plane.film > 0.0)
    for reach in INSIDE:
        inside = plane.distance < reach
        films = plane.film[has_film & inside]
        if len(films) > LEAST_OPEN * inside.sum():
            break
    if not len(films):
        return Normalize(0.0, NO_FILM)
    high = float(films.max())
    low = float(plane.film[has_film & (plane.film <= high)].min())
    if high < UNIFORM * low:
        return Normalize(low / UNIFORM, high * UNIFORM)
    return Normalize(low, high) if high <= LINEAR * low else LogNorm(max(low, high / DECADES), high)
