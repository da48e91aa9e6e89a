"""How far from the centre the peaks of rough bodies may touch: beyond the semi-axes of Hertz the gap opens
slowly, and a peak that is higher than it carries load. The lighter the load, the farther."""

import numpy as np

NODES = 257
"""Along each side: where heights are looked at."""

LOOKED_AT_FIRST, LOOKED_AT_LAST = 1.5, 30.0
"""Semi-axes within which the highest peak is looked for at first, and up to which peaks are looked for at
all: a surface that touches beyond has a form, not a roughness."""

DISTANCES = np.geomspace(1.0, LOOKED_AT_LAST, 240)
"""Distances at which the highest peak is tried, each 1.4 % beyond the one before."""


def reach_of_peaks(contact, film):
    """How far along X and Y, in their units, peaks reach through gap and `film` (m); 0 where none does.
    Looked for as far as the highest peak could touch."""
    if contact.surface is None:
        return 0.0, 0.0
    ends = LOOKED_AT_FIRST, LOOKED_AT_FIRST
    for _ in range(2):  # farther out there may be a higher one
        ends = _farthest(contact, _over_film(contact, film, *_nodes(contact, *ends)).max())
    X, Y = _nodes(contact, *ends)
    touching = _over_film(contact, film, X, Y) > _dry_gap(contact, X, Y)
    return _largest(X, touching.any(axis=0)), _largest(Y, touching.any(axis=1))


def _nodes(contact, X, Y):
    """Where heights are looked at: X (1, nx) and Y (ny, 1)."""
    side = np.linspace(-1.0, 1.0, NODES)
    return X * side[None, :], np.zeros((1, 1)) if contact.is_line else Y * side[:, None]


def _over_film(contact, film, X, Y):
    """Heights over their mean and the film, (ny, nx), in units of H."""
    heights = contact.surface.height(X * contact.x_scale, Y * contact.y_scale)
    over = (heights - contact.mean_height - film) / contact.film_scale
    return np.broadcast_to(over, (Y.size, X.size))


def _dry_gap(contact, X, Y):
    """Gap of the dry contact in units of H, as wide as it may be on a soft layer."""
    wide = contact.reach
    return wide**2 * contact.dry_gap(*np.broadcast_arrays(X / wide, Y / wide))


def _farthest(contact, height):
    """Where the gap is as large as a height, in units of H, along X and along Y."""
    distances, beside = contact.reach * DISTANCES, np.zeros(DISTANCES.size)
    gaps = _dry_gap(contact, distances, beside), _dry_gap(contact, beside, distances)
    return tuple(float(distances[min(np.searchsorted(gap, height), DISTANCES.size - 1)]) for gap in gaps)


def _largest(positions, found):
    """The largest distance from the centre of the positions that were found; 0 of none."""
    return float(np.abs(positions.ravel()[found]).max(initial=0.0))
