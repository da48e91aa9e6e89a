"""Films with no more digits than they have: 12.1 ± 0.4."""

import re
from math import ceil, floor, isfinite, log10

MOST_DECIMALS = 9
"""Most decimals of nanometres: far below an atom, and within what a double holds."""


def is_number(text):
    """True of a number, of one with its band, and of two as in "3 of 7" or "3..7"."""
    try:
        for part in re.split(r" ± | of |\.\.", text):
            float(part)
    except ValueError:
        return False
    return True


def with_band(value, half_width):
    """A film and the half-width of its band, both of one unit; four decimals where there is no band."""
    if half_width is None or not (isfinite(value) and isfinite(half_width)):
        return plain(value)
    decimals = decimals_of(half_width)
    return f"{rounded(value, decimals)} ± {rounded(half_width, decimals, up=True)}"


def plain(value):
    """A film without a band: four digits after the point; of a diverged run four in all."""
    return f"{round(value, 4) + 0.0:.4f}" if abs(value) < 1e7 else f"{value:.3e}"


def decimals_of(half_width):
    """Decimals with which a half-width has one digit, or two that begin with a 1; below 0 whole tens."""
    if half_width <= 0.0:
        return MOST_DECIMALS
    first = floor(log10(half_width))
    leading = half_width / 10.0**first
    return min(MOST_DECIMALS, -first + (1 if leading <= 1.9 else 0))


def rounded(value, decimals, up=False):
    """A number with so many decimals, rounded `up` where it must not be smaller."""
    unit = 10.0**-decimals
    steps = ceil(value / unit * (1.0 - 1e-12)) if up else round(value / unit)
    return f"{steps * unit + 0.0:.{max(0, decimals)}f}"
