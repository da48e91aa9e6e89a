"""The scale of a map of the film, and round numbers for lines of equal film."""

import numpy as np
from matplotlib.colors import LogNorm, Normalize
from matplotlib.ticker import LogLocator, MaxNLocator

from mgehl.discretization.status import CONTACT
from mgehl.output.pictures.lines import SMALLEST_FILM_RANGE

INSIDE, ABOUT = 0.9, 1.25
"""Parts of the loaded zone whose films make the scale: its rim is steep. The larger one where there is
hardly any film in the smaller."""
LEAST_OPEN = 0.02
"""Part of the loaded zone from which its film, where there is any, makes the scale."""
DECADES = 1e4
"""Largest ratio of films on one map: thinner ones are drawn as the thinnest."""
UNIFORM = 1.1
"""Ratio of films below which they are all one on the map."""
LINEAR_UP_TO = 8.0
"""Ratio of films from which the map's scale is logarithmic."""


def film_scale(distance, film, status):
    """Norm of the open film, from its least on the map to the largest inside the loaded zone.

    `distance` is 1 on the zone's edge. Logarithmic where the film spans more than LINEAR_UP_TO.
    """
    open_film = (status != CONTACT) & (film > 0.0)
    films = film[open_film & _part(distance, open_film)]
    if not len(films):
        return Normalize(0.0, SMALLEST_FILM_RANGE)
    high = float(films.max())
    low = float(film[open_film & (film <= high)].min())
    return norm_between(low, high)


def norm_between(low, high):
    """Norm of films from `low` to `high`, both above 0: linear or logarithmic by their ratio."""
    if high < UNIFORM * low:
        return Normalize(low / UNIFORM, high * UNIFORM)
    if high <= LINEAR_UP_TO * low:
        return Normalize(low, high)
    return LogNorm(max(low, high / DECADES), high)


def levels_of(norm):
    """Round numbers within the scale."""
    locator = LogLocator(subs=(1.0, 2.0, 5.0)) if isinstance(norm, LogNorm) else MaxNLocator(6)
    levels = np.asarray(locator.tick_values(norm.vmin, norm.vmax))
    return levels[(levels > norm.vmin) & (levels < norm.vmax)]


def _part(distance, open_film):
    """Where the films are that make the scale."""
    inside = distance < INSIDE
    if (open_film & inside).sum() > LEAST_OPEN * inside.sum():
        return inside
    about = distance < ABOUT
    return about if (open_film & about).any() else np.ones_like(about)
