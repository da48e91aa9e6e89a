"""Orders and limits of numbers on grids that are each twice as fine; whether bands hold the limits."""

from math import isfinite, log2, nan
from operator import attrgetter
from typing import NamedTuple

import numpy as np

from mgehl.output.digits import with_band
from mgehl.output.quantities import QUANTITIES
from mgehl.studies.columns import statistic, told

PLAUSIBLE_ORDERS = (0.5, 3.0)
"""Orders outside of this range come from values that are too far from their limit to tell it."""


def order_of_errors(coarse, fine):
    """Power of the spacing by which an error falls when that is halved."""
    return log2(abs(coarse) / abs(fine)) if coarse and fine else nan


def richardson(values):
    """(limit, observed order) from the values on the last three grids, each twice as fine. NaN where the
    differences do not fall with one sign: there is no limit to see yet."""
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


class JudgedBand(NamedTuple):
    """A number with the half-width of its band beside its limit, all in one unit; None without a band."""

    value: float
    half_width: float | None
    limit: float

    @property
    def off(self):
        """The true error."""
        return abs(self.limit - self.value)

    @property
    def holds(self):
        """Whether the limit lies within the band."""
        return self.off <= self.half_width

    @property
    def known(self):
        """Whether there is a band, and a limit to judge it by."""
        return self.half_width is not None and isfinite(self.limit)

    @property
    def over_error(self):
        """Half-width over the true error; marked where the band does not hold the limit."""
        if not self.known or not self.off > 0.0:
            return ""
        return f"{self.half_width / self.off:.2f}{'' if self.holds else ' !'}"


def number_of(name, result):
    """The quantity of a `Result`."""
    return attrgetter(QUANTITIES[name].path)(result)


def judged(title, solution, columns, limits, banded):
    """The row of a case's `Solution`, with some columns of `columns.COLUMNS`, and {name: `JudgedBand`} of
    the numbers that are `banded`, {name: quantity}, by their `limits`."""
    result, bands = solution.result, {}
    row = {"contact": title, "nodes": str(solution.mesh.nx), **told(result, columns)}
    for name, quantity in banded.items():
        found = QUANTITIES[quantity]
        band = JudgedBand(number_of(quantity, result), attrgetter(found.band)(result), limits[name])
        unit = "" if found.unit == "1" else f" {found.unit}"
        row[f"{name}{unit}"] = with_band(band.value, band.half_width)
        row[f"{name} limit{unit}"] = f"{band.limit:.4g}"
        row[f"{name} band/error"] = band.over_error
        bands[name] = band
    return row, bands


def summary(bands):
    """A row for each name of `bands`, {name: [JudgedBand]}: how often they hold the limit, and how wide."""
    for name, found in bands.items():
        known = [band for band in found if band.known]
        held = sum(band.holds for band in known)
        yield {
            "of": name,
            "bands": str(len(known)),
            "hold the limit": str(held),
            "in %": f"{100.0 * held / max(len(known), 1):.0f}",
            "median of half-width/error": _median(b.half_width / b.off for b in known if b.off > 0.0),
            "median half-width %": _median(100.0 * b.half_width / b.value for b in known if b.value),
            "median error %": _median(100.0 * b.off / b.limit for b in known if b.limit),
        }


def _median(values):
    return statistic(np.median, values, "{:.2f}")
