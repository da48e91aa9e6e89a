"""How far a film is from its limit: a band from films of grids, each twice as coarse as the one before."""

from dataclasses import dataclass
from math import log2

SAFETY = 0.25
"""Part of the central film's estimated error that is added to it where three grids show the scheme's order,
as in Roache's grid convergence index. The parts here were chosen so that 95 of 100 bands hold the limit, by
103 random contacts of M from 10 to 2000 and L from 2 to 14 by the default scheme, each on three grids.
`study error --cases` tries them on others."""

IRREGULAR = 0.7
"""The same where three grids show another order, or none."""

UNSEEN = 1.0
"""The same where there are only two grids, and the order is the scheme's on trust."""

UNLIKE = 2.0
"""The same where the coarser grid has another film, with contact or an inlet of less than a cell: three
times the error, as Roache has it where nothing is known."""

SMALLEST = 1e-4
"""Half-width over the film at the least: films of two grids may differ by less, by chance."""

SLOWEST = 0.75
"""An observed order below this part of the scheme's is not believed: the coarsest grid is too coarse to
show it, or errors of two kinds cancel there."""

FASTER = 0.5
"""By how much the observed order may exceed the scheme's. Beyond that, the last difference is taken to be
small by chance. With 0 bands are wider, by a tenth in the median of the minimum film; with 1 some are
too narrow on 129 nodes, whose coarsest grid has errors of every order."""


SPREADS, SPREADS_UNLIKE = 1.5, 2.25
"""Safety of the minimum film: what is added of the estimated error's spread around it, and where the next
grid has another film. 96 of 100 bands of the same contacts hold the limit. With a part of the error itself,
as for the central film, it would be 91, and half the bands were wider by a tenth."""

OFF = 0.25
"""Part that is added of the distance between the film of a node and that between the nodes."""


@dataclass(frozen=True)
class Band:
    """Half-width of the band about a film, within which its limit is to lie, in the film's unit."""

    half_width: float
    observed_order: float | None
    """Of three grids; None of two, or where their differences are of different signs."""


def band(film, values, order, unlike=False):
    """The `Band` about a `film` of nodes, from two or three `values` between nodes, finest grid's first.

    The last difference and the order tell the error (Richardson). The order is the scheme's, or the
    observed one where that is somewhat lower. From the order and the difference before, the last difference
    can be foretold. One that is clearly smaller is small by chance, for example because it changes its
    sign: what it lacks is added. So is a part of the node's distance from the value between the nodes.
    `unlike` says that the second grid has another film.
    """
    last, *before = (finer - coarser for finer, coarser in zip(values, values[1:], strict=False))
    observed = observed_order(last, *before)
    error, off = last / (2.0 ** believed(order, observed) - 1.0), values[0] - film
    safety = UNLIKE if unlike else safety_of(order, observed, len(values))
    added = safety * abs(error) + OFF * abs(off) + by_chance(order, last, *before)
    return Band(max(abs(error + off) + added, SMALLEST * abs(film)), observed)


def band_of_smallest(film, values, spread, order, unlike=False):
    """The same about the film of the smallest node; `values` are those of `films.films_beside`.

    What differs from grid to grid around the smallest gap changes its sign from node to node. So the
    order that it shows means little, and its mean may be small by chance: the safety is its `spread`. Of
    two grids a part of the error is added.
    """
    last, *before = (finer - coarser for finer, coarser in zip(values, values[1:], strict=False))
    part, off = 1.0 / (2.0**order - 1.0), values[0] - film
    safety = (SPREADS_UNLIKE if unlike else SPREADS) * part * spread + OFF * abs(off)
    unseen = 0.0 if before else SAFETY * part * abs(last)
    half_width = abs(part * last + off) + safety + unseen
    return Band(max(half_width, SMALLEST * abs(film)), observed_order(last, *before))


def band_beside(film, others, order):
    """The `Band` about a `film`, from one or two values of `others`: coarser grids', by a better scheme.

    This is for schemes of first order. Their own differences tell nothing, because their error cancels more
    or less of the other errors. With two others the limit is Richardson's, and its distance from the finer
    one is added. With one, the limit lies between film and other, since first order makes films too thick
    and second order too thin.
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


def safety_of(order, observed, grids):
    """Part of the error that is added where so many grids show the `observed` order, or None."""
    if grids < 3:
        return UNSEEN
    as_the_scheme = observed is not None and SLOWEST * order <= observed <= order + FASTER
    return SAFETY if as_the_scheme else IRREGULAR


def by_chance(order, last, before=0.0):
    """By how much a `last` difference is smaller than the one `before` it foretells; zero where it is
    not."""
    expected = abs(before) / 2.0 ** (order + FASTER)
    return max(0.0, expected - abs(last)) / (2.0**order - 1.0)
