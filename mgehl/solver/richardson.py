"""How far a film is from its limit: a band from films of grids, each twice as coarse as the one before."""

from dataclasses import dataclass
from math import hypot, log2

SAFETY = 0.25
"""Part of the central film's estimated error that is added to it where three grids show the scheme's order,
as in Roache's grid convergence index. The parts here were chosen so that 95 of 100 bands hold the limit, by
103 random contacts of M from 10 to 2000 and L from 2 to 14 by the default scheme, each on three grids.
`study error --cases` tries them on others."""

IRREGULAR = 0.7
"""The same where three grids show another order, or none."""

UNLIKE = 2.0
"""The same where the coarser grid has another film, with contact or an inlet of less than a cell: three
times the error, as Roache has it where nothing is known."""

UNSEEN, UNSEEN_UNLIKE = 1.2, 2.5
"""Safety where there are only two grids, which show no order: how many times the error's root mean square
around the centre is added, as squares are. Two films may agree in one point by chance, hardly in all points
around it. The second number is for another film on the coarser grid. Of 128 contacts on 65 nodes 98 of 100
bands hold the limit. With twice the error of the centre alone it would be 88."""

SMALLEST = 1e-4
"""Half-width over the film at the least: films of two grids may differ by less, by chance."""

SLOWEST = 0.75
"""An observed order below this part of the scheme's is not believed: the coarsest grid is too coarse to
show it, or errors of two kinds cancel there."""

FASTER = 0.5
"""By how much the observed order may exceed the scheme's. Beyond that, the last difference is taken to be
small by chance. With 0 bands are wider; with 1 some are too narrow on 129 nodes, whose coarsest grid has
errors of every order."""


SPREADS, SPREADS_OF_TWO, WIDER = 0.9, 1.3, 2.0
"""Safety of the minimum film: how much of the estimated error's spread around it is added, with three grids
and, as squares are, with two; and by how much more where the next grid has another film. Of 397 bands by
the default scheme, by which they were chosen, 96 of 100 hold the limit."""

OFF = 0.25
"""Part that is added of the distance between the film of a node and that between the nodes."""


@dataclass(frozen=True)
class Band:
    """Half-width of the band about a film, within which its limit is to lie, in the film's unit."""

    half_width: float
    observed_order: float | None
    """Of three grids; None of two, or where their differences are of different signs."""


def band(film, values, around, order, unlike=False):
    """The `Band` about a `film` of nodes, from two or three `values` between nodes, finest grid's first.

    The last difference and the order tell the error (Richardson). The order is the scheme's, or the
    observed one where that is somewhat lower. From the order and the difference before, the last difference
    can be foretold. One that is clearly smaller is small by chance, for example because it changes its
    sign: what it lacks is added. Of two grids the safety comes from the last difference `around` the
    centre, a root mean square. A part of the node's distance from the value between the nodes is added.
    `unlike` says that the second grid has another film.
    """
    last, *before = (finer - coarser for finer, coarser in zip(values, values[1:], strict=False))
    observed = observed_order(last, *before)
    part, off = 1.0 / (2.0 ** believed(order, observed) - 1.0), values[0] - film
    error = abs(part * last + off)
    if before:
        safety = UNLIKE if unlike else safety_of(order, observed)
        half_width = error + safety * abs(part * last) + by_chance(order, last, *before)
    else:
        half_width = hypot(error, (UNSEEN_UNLIKE if unlike else UNSEEN) * part * around)
    return Band(max(half_width + OFF * abs(off), SMALLEST * abs(film)), observed)


def band_of_smallest(film, values, spread, order, unlike=False):
    """The same about the film of the smallest node; `values` are those of `films.films_beside`.

    What differs from grid to grid around the smallest gap changes its sign from node to node. So the
    order that it shows means little, and its mean may be small by chance: the safety is its `spread`. Nor
    does the mean make the node's distance from the value between the nodes smaller, for its sign is wrong
    for every third film. Of two grids a part of the error is added.
    """
    last, *before = (finer - coarser for finer, coarser in zip(values, values[1:], strict=False))
    part, off = 1.0 / (2.0**order - 1.0), values[0] - film
    error, wider = part * abs(last), WIDER if unlike else 1.0
    least = max(abs(off), abs(part * last + off))
    if before:
        half_width = least + wider * SPREADS * part * spread + OFF * abs(off)
    else:
        half_width = hypot(least + SAFETY * error, wider * SPREADS_OF_TWO * part * spread)
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


def safety_of(order, observed):
    """Part of the error that is added where three grids show the `observed` order, or None."""
    as_the_scheme = observed is not None and SLOWEST * order <= observed <= order + FASTER
    return SAFETY if as_the_scheme else IRREGULAR


def by_chance(order, last, before):
    """By how much a `last` difference is smaller than the one `before` it foretells; zero where it is
    not."""
    expected = abs(before) / 2.0 ** (order + FASTER)
    return max(0.0, expected - abs(last)) / (2.0**order - 1.0)
