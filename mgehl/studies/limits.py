"""Orders and limits of numbers on grids that are each twice as fine."""

from math import log2, nan

PLAUSIBLE_ORDERS = (0.5, 3.0)
"""Orders outside of this range come from values that are too far from their limit to tell it."""


def observed_order(coarse, fine):
    """Power of the spacing by which an error falls when that is halved."""
    return log2(abs(coarse) / abs(fine)) if coarse and fine else nan


def richardson(values):
    """(limit, observed order) from the values on the last three grids, each twice as fine.

    NaN where the differences do not fall with one sign: there is no limit to see yet.
    """
    coarse, middle, fine = values[-3:]
    first, second = middle - coarse, fine - middle
    if second == 0.0 or not first / second > 1.0:
        return nan, nan
    ratio = first / second
    return fine + second / (ratio - 1.0), log2(ratio)


def limit_said(values, shown):
    """`shown.format(limit, order)`, where the last three values show an order that can be one."""
    limit, order = richardson(values)
    plausible = PLAUSIBLE_ORDERS[0] <= order <= PLAUSIBLE_ORDERS[1]
    return shown.format(limit, order) if plausible else "not to be told yet"
