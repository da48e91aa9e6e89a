"""How far a film is from its limit: a band from films of grids, each twice as coarse as the one before."""

from dataclasses import dataclass
from math import log2

SAFETY = 1.0 / 3.0
"""Part of the estimated error that is added to it where three grids show its order. Roache's grid
convergence index adds a quarter."""

UNSEEN = 0.5
"""The same where there are only two grids, and the order is the scheme's on trust."""

TOUCHED = 2.0
"""The same where the coarser grid has contact, and so not the film that it would have were it free to:
three times the error, as Roache where nothing is known."""

SLOWEST = 0.75
"""Part of the scheme's order below which an observed one is not believed: the coarsest grid is too coarse
to show one, or errors of two kinds cancel there."""

FASTER = 0.5
"""What an order may seem higher than the scheme's before the last difference is held to be small by chance.
With 0 bands are wider, by a tenth in the median of the minimum film; with 1 some are too narrow on 129
nodes, whose coarsest grid has errors of every order."""


@dataclass(frozen=True)
class Band:
    """Half-width about a film that is to hold its limit, in the film's unit."""

    half_width: float
    observed_order: float | None
    """Of three grids; None of two, or where their differences are of different signs."""


def band(film, values, order, touched=False):
    """The `Band` about a `film` of nodes, from two or three `values` between nodes, finest grid's first.

    The last difference and the order tell the error (Richardson). The order is the scheme's, or the
    observed one where that is somewhat lower. Where the last difference is smaller than that order makes
    of the one before, and clearly, it is small by chance, as where it changes its sign: what it lacks is
    added.
    By what the film of nodes is off the value between nodes it is off its limit, too. `touched` says that
    the second grid has contact.
    """
    last, *before = (finer - coarser for finer, coarser in zip(values, values[1:], strict=False))
    observed = observed_order(last, *before)
    error, off = last / (2.0 ** believed(order, observed) - 1.0), values[0] - film
    safety = TOUCHED if touched else SAFETY if before else UNSEEN
    half_width = abs(error + off) + safety * (abs(error) + abs(off)) + by_chance(order, last, *before)
    return Band(half_width, observed)


def band_beside(film, others, order):
    """The `Band` about a `film`, from one or two values of `others`, coarser grids' by a better scheme.

    For a scheme of first order, whose error and that of the rest of the equations cancel now more, now
    less: its own differences tell nothing. Of two others the limit is Richardson's, and what it is off the
    finer one is added; of one it lies between film and other, since first order makes films too thick and
    second order too thin.
    """
    finer, *coarser = others
    error = (finer - coarser[0]) / (2.0**order - 1.0) if coarser else 0.0
    return Band(abs(finer + error - film) + abs(error), None)


def observed_order(last, before=0.0):
    """Power of the spacing by which two differences fall; None where their signs differ, or of one."""
    return log2(before / last) if last * before > 0.0 else None


def believed(order, observed):
    """The order by which an error is told, from the scheme's and the observed one."""
    return observed if observed and SLOWEST * order <= observed <= order else order


def by_chance(order, last, before=0.0):
    """What the error of a `last` difference lacks that is smaller than the one `before` lets expect."""
    expected = abs(before) / 2.0 ** (order + FASTER)
    return max(0.0, expected - abs(last)) / (2.0**order - 1.0)
