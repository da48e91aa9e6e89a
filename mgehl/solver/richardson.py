"""How far a film is from its limit: a band from films of grids, each twice as coarse as the one before."""

from dataclasses import dataclass
from math import log2

SAFETY = 0.25
"""Part of the estimated error that is added to it: the 1.25 of Roache's grid convergence index."""

TOUCHED = 1.0
"""The same where the coarser grid has contact: its film would be thinner still, were it free to be."""


@dataclass(frozen=True)
class Band:
    """Half-width about a film that is to hold its limit, in the film's unit."""

    half_width: float
    observed_order: float | None
    """Of three grids; None of two, or where their differences are of different signs."""


def band(film, values, order, safety=SAFETY):
    """The `Band` about a `film` of nodes, from two or three `values` between nodes, finest grid's first.

    A scheme of this `order` halves its error that often from grid to grid, so the last difference tells
    the error (Richardson). Where the difference before it, reduced by the order, is larger, the last one is
    small by chance, such as where it changes its sign: what it lacks is added. What the film of nodes is
    off the value between nodes it is off its limit, too. The part `safety` of either is added.
    """
    ratio = 2.0**order
    differences = [finer - coarser for finer, coarser in zip(values, values[1:], strict=False)]
    error, off = differences[0] / (ratio - 1.0), values[0] - film
    before = max((abs(each) / ratio for each in differences[1:]), default=0.0)
    by_chance = max(0.0, before - abs(differences[0])) / (ratio - 1.0)
    half_width = abs(error + off) + safety * (abs(error) + abs(off)) + by_chance
    return Band(half_width, observed_order(differences))


def observed_order(differences):
    """Power of the spacing by which two differences fall, the finer one first."""
    if len(differences) < 2 or not differences[0] * differences[1] > 0.0:
        return None
    return log2(differences[1] / differences[0])
