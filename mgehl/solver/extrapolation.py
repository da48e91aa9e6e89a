"""What comes after states in time, by a polynomial through them, and pressures that fade."""

import numpy as np


def weights_at(nodes, point):
    """Lagrange's weights of values at some `nodes`, by which a polynomial through them has its value at a
    `point`."""
    return np.array(
        [np.prod([(point - other) / (each - other) for other in nodes if other != each]) for each in nodes]
    )


def curvature(times, values):
    """Half the second derivative of a parabola through the values at three times."""
    first, second, third = times
    slopes = (values[1] - values[0]) / (second - first), (values[2] - values[1]) / (third - second)
    return (slopes[1] - slopes[0]) / (third - first)


def alike(one, other):
    """What two arrays have in common: the smaller of each pair, nothing where their signs differ."""
    return np.where(one * other > 0.0, np.where(np.abs(one) < np.abs(other), one, other), 0.0)


def fading(P, standing, t, nothing):
    """The pressures `P` that a parabola leads to at a time `t`; where it falls by more than half to
    `nothing`, those that fade as they did before. Peaks that leave the contact would be gone at once, and
    a handful of such nodes makes up most of a guess's residual. `standing` has the `times` and P before."""
    if len(standing.times) < 2:
        return P
    before, last = standing.P[-2:] - nothing
    steps = (t - standing.times[-1]) / (standing.times[-1] - standing.times[-2])
    fades = (0.0 < last) & (last < before) & (P - nothing < 0.5 * last)
    P[fades] = np.maximum(P[fades], nothing + last[fades] * (last[fades] / before[fades]) ** steps)
    return P
