"""Films with no more digits than they have: 12.1 ± 0.4."""

import re
from math import ceil, floor, isfinite, log10

from mgehl.kinds.kind import film_unit, pressure_unit

MOST_DECIMALS = 9
"""Most decimals of nanometres: far below an atom, and within what a double holds."""

LARGE = 1e7
"""From here on a number is told with four digits."""

SMALL = 1e-7
"""The same below this: of a coefficient."""


def is_number(text):
    """True of a number, of one with its band, and of two as in "3 of 7" or "3..7"."""
    try:
        for part in re.split(r" ± | of |\.\.", text):
            float(part)
    except ValueError:
        return False
    return True


def with_band(value, half_width=None, digits=None):
    """A film and the half-width of its band, both of one unit, with one digit, or two that begin with a 1.
    Without a band it has so many `digits`, or four after the point; of a diverged run four in all."""
    if half_width is None and digits:
        return f"{value:.{digits}g}"
    known = half_width is not None and isfinite(value) and isfinite(half_width)
    is_small = known and 0.0 < half_width < abs(value) < SMALL
    if not known or abs(value) >= LARGE or is_small:
        band = f" ± {half_width:.1e}" if known else ""
        return f"{value:.3e}{band}" if band or abs(value) >= LARGE else f"{round(value, 4) + 0.0:.4f}"
    decimals = MOST_DECIMALS
    if half_width > 0.0:
        first = floor(log10(half_width))
        decimals = min(MOST_DECIMALS, -first + (half_width / 10.0**first <= 1.9))
    unit, shown = 10.0**-decimals, max(0, decimals)  # below 0 whole tens
    wide = ceil(half_width / unit * (1.0 - 1e-12)) * unit  # never narrower than it is
    return f"{round(value / unit) * unit + 0.0:.{shown}f} ± {wide:.{shown}f}"


def film_words(nm, half_width=None, digits=None):
    """A film, with its band if there is one; else as `with_band`."""
    factor, unit = film_unit(1e-9 * nm)
    factor *= 1e-9
    return f"{with_band(factor * nm, half_width and factor * half_width, digits)} {unit}"


def pressure_words(GPa, half_width=None):
    """A pressure, with its band if there is one."""
    factor, unit = pressure_unit(GPa)
    if half_width is None and factor > 1.0:
        return f"{factor * GPa:.4g} {unit}"
    return f"{with_band(factor * GPa, half_width and factor * half_width)} {unit}"
