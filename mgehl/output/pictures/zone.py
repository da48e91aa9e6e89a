"""Where the load is carried, in mm: maps show it, and their scales hold inside it."""

from typing import NamedTuple

import numpy as np

from mgehl.discretization.status import CONTACT

MARGIN = 0.45
"""Room about the loaded zone on a map, over the geometric mean of its semi-axes."""


class Zone(NamedTuple):
    """An ellipse with axes along x and y: its centre and its semi-axes, in mm."""

    x: float
    y: float
    half_x: float
    half_y: float

    def distance(self, x, y):
        """Distance from its centre, 1 on the ellipse: (ny, nx) of x (nx,) and y (ny,) in mm."""
        along, across = (x - self.x) / self.half_x, (y - self.y) / self.half_y
        return np.hypot(along[None, :], across[:, None])


def millimetres(solution):
    """Nodes along x (nx,) and along y (ny,)."""
    return 1e3 * solution.x, 1e3 * solution.y


def hertz_zone(contact):
    """The `Zone` of the dry contact of smooth half-spaces."""
    return Zone(0.0, 0.0, 1e3 * contact.x_scale, 1e3 * contact.y_scale)


def loaded_zone(solution):
    """The `Zone` that carries the load: a Hertz pressure on it has the same moments as the run's.

    So it is that of Hertz where the bodies are smooth half-spaces with a thin film, and as wide as the
    contact where they are coated, rough or far apart.
    """
    x, y = millimetres(solution)
    P = np.maximum(np.nan_to_num(solution.fields.P, posinf=0.0), 0.0)
    P = P / (P.max() or 1.0)
    hertz = hertz_zone(solution.contact)
    centre_x, half_x = _moments(x, P.sum(axis=0), hertz.half_x)
    centre_y, half_y = _moments(y, P.sum(axis=1), hertz.half_y)
    return Zone(centre_x, centre_y, half_x, half_y)


def window(solution, zone):
    """Slices of the nodes along x and along y that a map shows: zone, contact and Hertz, with room."""
    x, y = millimetres(solution)
    contact, hertz = solution.fields.status == CONTACT, hertz_zone(solution.contact)
    room = MARGIN * np.sqrt(zone.half_x * zone.half_y)
    ends_x = zone.x - zone.half_x, zone.x + zone.half_x, -hertz.half_x, hertz.half_x
    ends_y = zone.y - zone.half_y, zone.y + zone.half_y, -hertz.half_y, hertz.half_y
    return (
        _part(x, [*ends_x, *x[contact.any(axis=0)]], room),
        _part(y, [*ends_y, *y[contact.any(axis=1)]], room),
    )


def _moments(position, weights, default):
    """Centre and semi-axis of the Hertz pressure with these moments; the `default` where there are none."""
    total = weights.sum()
    if not total > 0.0:
        return 0.0, default
    centre = weights @ position / total
    # The mean of x^2 over a Hertz pressure is a^2/5.
    half = np.sqrt(5.0 * (weights @ (position - centre) ** 2) / total)
    return float(centre), float(half) or default


def _part(position, ends, room):
    first, last = np.searchsorted(position, (min(ends) - room, max(ends) + room))
    return slice(max(int(first) - 1, 0), int(last) + 1)
