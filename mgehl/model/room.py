"""A domain with room for the film, and not more: what "auto" stands for.

Its sides are tried at distances by which each takes the same share of the film, until what they take is
little enough; peaks that touch outside (`peaks`) lie within. Where the load beyond is not counted
(`far_field`), light loads would ask for a hundred semi-axes: as far as the inlet keeps its cells.
"""

from math import ceil, hypot, sqrt

import numpy as np

from mgehl.model.contact import RESOLVED_CELLS
from mgehl.model.peaks import reach_of_peaks

ALLOWED = 0.3
"""Per cent of film, as estimated, that a domain of twice the size may have more: truly it may be 0.5."""

NEAREST = 0.25
"""Semi-axes between the contact, peaks outside it too, and every side, where the film asks for less."""

SHARES = np.geomspace(0.1, ALLOWED / 400.0, 80)
"""Of the film, that one side may take: tried from the largest on, to a quarter of what all may."""

SPARE = 1.1
"""Cells of the inlet over those that resolve it, on a domain that the load widens."""

STEP = 0.05
"""To a multiple of it the ends are rounded up, in semi-axes."""

PARTS = 32
"""Cells of the coarsest grid along a side: the centre of the contact is to be a node of it."""


def domain_for(starvation, nodes, farthest):
    """The smallest x and y in which a film loses no more than `ALLOWED`, up to `farthest` semi-axes. The
    film and its contact are those of a `Starvation`. With too few `nodes` light loads lose more."""
    peaks = reach_of_peaks(starvation.contact, starvation.film)
    for share in SHARES:
        x, y = _ends(starvation, share, nodes, farthest, peaks)
        if starvation.lost(x, y) <= ALLOWED:
            break
    return x, y


def _ends(starvation, share, nodes, farthest, peaks):
    """x and y whose sides each take a share, and which hold the `peaks` that reach so far along X and Y."""
    upstream, beside, downstream = _rooms(starvation, share, nodes)
    # The contact of a soft layer may be wider than it is thought to be.
    wider = starvation.contact.reach / starvation.contact.widening
    ends = []
    for side, peak in zip(starvation.sides, np.repeat(peaks, 2), strict=False):
        along = abs(side.toward) * (upstream if side.toward > 0.0 else downstream)
        room = hypot(along, sqrt(1.0 - side.toward**2) * beside) + wider * side.half
        ends.append(min(max(_rounded_up(room / side.unit), end_beyond(peak)), farthest))
    west, east, *across = ends
    return interval_on_nodes(west, east), interval_on_nodes(*across) if across else (0.0, 0.0)


def end_beyond(peak):
    """End of a domain that holds a peak which touches so far from the centre; 0 where none does."""
    return _rounded_up(peak + NEAREST) if peak else 0.0


def _rounded_up(end):
    return round(STEP * ceil(end / STEP - 1e-9), 4)


def interval_on_nodes(before, after):
    """From at least so far before the centre to so far after it, so that the centre is a node."""
    short, long = sorted((before, after))
    cells = int(PARTS * long / (long + short) + 1e-9)
    short = long * (PARTS - cells) / cells
    return tuple(round(end, 4) for end in ((-long, short) if before >= after else (-short, long)))


def _rooms(starvation, share, nodes):
    """Metres between the contact and sides upstream, beside and downstream that each take a share."""
    contact, hertz = starvation.contact, starvation.like.hertz
    resolved = (nodes - 1) / (SPARE * RESOLVED_CELLS) * contact.inlet_length * contact.x_scale
    by_load = [(lost / share) ** (1.0 / starvation.order) for lost in starvation.by_load]
    powers = [max(each) for each in zip(*starvation.powers, strict=True)]
    downstream = hertz.a * max(sqrt(2.0 * starvation.dimensionless_film) - 1.0, NEAREST)
    downstream = max(downstream, min(starvation.way_behind(share), 0.5 * resolved) - hertz.a)
    for_load = min(by_load[0], resolved - downstream - hertz.a) - hertz.a
    upstream = max(hertz.a * NEAREST, hertz.a * starvation.upstream.way(share / powers[0]), for_load)
    if contact.is_line:
        return upstream, 0.0, downstream
    for_load = min(by_load[1], 0.5 * resolved) - hertz.b
    beside = max(hertz.b * NEAREST, hertz.b * starvation.beside.way(share / powers[1]), for_load)
    return upstream, beside, downstream
