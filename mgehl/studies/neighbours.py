"""What a point of a sweep starts from: the one before, or what is forecast from the two before."""

from itertools import pairwise
from math import log

from mgehl.solver.restart import Forecast

NEAR = 4.0
"""Ratio of two films, and of two steps along a key, within which what changes is forecast."""


def start_of(behind, axes, point):
    """What a point starts from: the last one, or what is forecast from the last two of one line."""
    if not behind or point.config.is_in_time:
        return None
    last = behind[-1][1]
    if point.config.is_dry or not last.contact.is_loaded:
        return last
    if len(behind) < 2:
        return Forecast(last)
    places = [*(each.place for each, _ in behind), point.place]
    moved = [[k for k, (a, b) in enumerate(zip(*pair, strict=True)) if a != b] for pair in pairwise(places)]
    if len(moved[0]) != 1 or moved[0] != moved[1]:
        return Forecast(last)
    axis = axes[moved[0][0]]
    factor = _factor([axis.values[place[moved[0][0]]] for place in places], *(each for _, each in behind))
    return Forecast(last, behind[0][1], factor) if factor else Forecast(last)


def _factor(values, before, last):
    """Change that is expected of the next solution, over that between two; None where none can be.

    The film goes by a power of the key, all else as the film: from 0.5 to 0.3 m/s a rough ball's comes
    within a per cent.
    """
    x = [log(value) for value in values] if min(values) > 0.0 else values
    steps, films = (x[2] - x[1]) / (x[1] - x[0]), [_film(each.result) for each in (before, last)]
    if not 0.0 < steps < NEAR or not min(films) > 0.0 or not max(films) < NEAR * min(films):
        return None
    ratio = films[1] / films[0]
    return steps if abs(ratio - 1.0) < 1e-6 else (ratio**steps - 1.0) / (1.0 - 1.0 / ratio)


def _film(result):
    return result.mixed.mean_gap_nm if result.mixed else result.central_film_nm
