"""How far from the centre the peaks of rough bodies may touch.

Smooth bodies touch within the semi-axes of Hertz. Beyond them the gap opens slowly at first: a peak that is
higher than the gap touches there, and carries load. The lighter the load, the farther (a ball of 0.1 N with
66 nm rms: 2.6 semi-axes).
"""

import numpy as np

from mgehl.model.contact import SAMPLES

FARTHEST = 30.0
"""Semi-axes up to which peaks are looked for: a surface that touches beyond has a form, not a roughness."""

DISTANCES = np.geomspace(1.0, FARTHEST, 240)
"""The distances that are tried, each 1.4 % beyond the one before."""


def reach_of_peaks(contact, film):
    """How far along X and Y, in their units, a peak reaches through gap and `film` (m); 0 where none does.

    The highest peak is looked for within the semi-axes, and then as far as that one reaches.
    """
    if contact.surface is None:
        return 0.0, 0.0
    reach = _reached_by(_highest(contact, 1.0, 1.0) - film, contact)
    return _reached_by(_highest(contact, *reach) - film, contact) if max(reach) > 0.0 else reach


def _highest(contact, X, Y):
    """The highest peak on the way to X and Y on both sides, in m over the mean within the semi-axes."""
    side = np.linspace(-1.0, 1.0, SAMPLES)
    x, y = X * contact.x_scale * side, (np.zeros(1) if contact.is_plane else Y * contact.y_scale * side)
    return float(contact.surface.height(x[None, :], y[:, None]).max()) - contact.mean_height


def _reached_by(height, contact):
    """Where the gap of the dry contact is as large as a `height` in m, along X and along Y."""
    if height <= 0.0:
        return 0.0, 0.0
    H, wide, beside = height / contact.film_scale, contact.reach, np.zeros(DISTANCES.size)
    along_x = wide * _first(wide**2 * contact.dry_gap(DISTANCES, beside) >= H)
    if contact.is_plane:
        return along_x, 0.0
    return along_x, wide * _first(wide**2 * contact.dry_gap(beside, DISTANCES) >= H)


def _first(found):
    """The first of the distances that was found, or the last of all."""
    return float(DISTANCES[np.argmax(found)] if found.any() else FARTHEST)
