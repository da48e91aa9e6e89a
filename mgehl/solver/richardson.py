"""How far a film is from its limit: a band from films of grids, each twice as coarse as the one before."""

from dataclasses import dataclass
from math import hypot, log2

SAFETY = 0.25
"""Part of the central film's estimated error that is added where three grids show the scheme's order, as in
Roache's index. `study error --cases` tries this file's safeties: chosen so that 95 of 100 bands hold."""

IRREGULAR = 0.7
"""The same where three grids show another order, or none."""

UNLIKE = 2.0
"""The same where the coarser grid has another film, with contact, or the inlet is not resolved: three times
the error, as Roache has it where nothing is known."""

UNSEEN, UNSEEN_UNLIKE = 1.2, 2.5
"""Safety where there are only two grids, which show no order: times the error's root mean square around the
centre, for films may agree in a point by chance; as squares are added. The second: another film on one."""

SMALLEST = 1e-4
"""Half-width over the film at the least: films of two grids may differ by less, by chance."""

SLOWEST = 0.75
"""An observed order below this part of the scheme's is not believed: the coarsest grid is too coarse to
show it, or errors of two kinds cancel there."""

FASTER = 0.5
"""By how much the observed order may exceed the scheme's. Beyond that, the last difference is taken to be
small by chance. With 0 bands are wider; with 1 some are too narrow."""

SPREADS, SPREADS_OF_TWO, WIDER = 0.9, 1.3, 2.0
"""Safety of the minimum film: how much of the estimated error's spread around it is added, with three grids
and, as squares are, with two; and by how much more where the next grid has another film."""

FIRST = 1.0
"""The least observed order that is believed of the smallest film, where the scheme's is higher. By the
scheme's alone 9 of 40 bands were too narrow about line contacts whose oil shear thins, by this 2; those
about points hardly change."""

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

    The last difference and the order, the scheme's or a somewhat lower observed one, tell the error
    (Richardson). Where the last difference is smaller than the one before foretells, it is so by chance,
    and what it lacks is added; of grids that show neither the film nor its order the error may be as large
    as either. Of two grids the safety comes from the last difference `around` the centre,
    a root mean square. Part of the node's distance is added. `unlike`: another film on the second.
    """
    last, *before = (finer - coarser for finer, coarser in zip(values, values[1:], strict=False))
    observed = observed_order(last, *before)
    part, off = 1.0 / (2.0 ** believed(order, observed) - 1.0), values[0] - film
    error = abs(part * last + off)
    if before:
        safety = UNLIKE if unlike else safety_of(order, observed)
        half_width = error + safety * abs(part * last) + by_chance(order, last, *before)
        if unlike and observed is not None and observed < SLOWEST * order:
            half_width = max(half_width, abs(*before))
    else:
        half_width = hypot(error, (UNSEEN_UNLIKE if unlike else UNSEEN) * part * around)
    return Band(max(half_width + OFF * abs(off), SMALLEST * abs(film)), observed)


def band_of_smallest(film, values, spread, order, unlike=False):
    """The same about the film of the smallest node; `values` are those of `films.films_beside`.

    Differences around the smallest gap change their sign from node to node: their mean tells little, so the
    safety is their `spread`. Where the last one is larger than that, an order below the scheme's is
    believed. The mean does not make the node's distance from the value smaller, its sign is wrong for every
    third film. Of two grids a part of the error is added.
    """
    last, *before = (finer - coarser for finer, coarser in zip(values, values[1:], strict=False))
    observed = observed_order(last, *before)
    is_slow = observed is not None and observed < order and abs(last) > spread
    orders = order, max(observed, FIRST) if is_slow else order
    part, of_error = (1.0 / (2.0**each - 1.0) for each in orders)
    off, wider = values[0] - film, WIDER if unlike else 1.0
    least = max(abs(off), abs(of_error * last + off))
    if before:
        half_width = least + wider * SPREADS * part * spread + OFF * abs(off)
    else:
        half_width = hypot(least + SAFETY * part * abs(last), wider * SPREADS_OF_TWO * part * spread)
    return Band(max(half_width, SMALLEST * abs(film)), observed)


def band_beside(film, others, order):
    """The `Band` about a `film`, from one or two values of `others`, coarser grids' by a better scheme.

    For schemes of first order, whose own differences tell nothing. With two others the limit is
    Richardson's, and its distance from the finer one is added. With one, the limit lies between film and
    other: first order makes films too thick, second too thin.
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
    """By how much a `last` difference is smaller, if it is, than the one `before` foretells."""
    expected = abs(before) / 2.0 ** (order + FASTER)
    return max(0.0, expected - abs(last)) / (2.0**order - 1.0)
