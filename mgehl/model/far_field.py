"""The load that a film carries beyond its domain: a tenth of it and more where a light load floats on oil.

Bodies that approach each other squeeze oil out there, too, as surfaces that move drag it in.

Far outside the bodies are rigid, and the pressure of Kapitza (1955) carries a load beyond a distance that
falls only as 1 over it: no grid resolves a domain that holds it all. The sides of the domain, where the
pressure is zero, lower the pressure within, too. Both follow from Reynolds' equation of a rigid gap h = h_0
+ x^2/2R_x + y^2/2R_y, solved once with the domain's sides and once without, on a few thousand nodes.
"""

from functools import lru_cache
from itertools import pairwise
from math import ceil, floor, log10, pi, sqrt

import numpy as np
from scipy.sparse import coo_matrix, diags
from scipy.sparse.linalg import spsolve

MOST = 0.5
"""Part of the load that may be missing at the most: beyond it the domain ends in the contact's own film."""

THINNER = 0.85
"""Films of rigid bodies over those of Nijenbanning, Venner and Moes: 0.86 of a ball, 0.81 to 0.86 for radii
of 4:1 to 1:30, where this module's grids say so. What is missing hardly answers to it."""

YIELDS, LEAST = 4.0 / pi**2, 0.1
"""What bodies yield in the middle of a rigid film, by Kapitza's pressure, over load/(E' sqrt(2 R h)); and
the part of the film that is left at the least."""

STEPS = (0.4, 0.28)
"""Steps in asinh of x over sqrt(2 R_x h_0), and y alike, on two grids. What is missing has an error by the
square of the step; the limit of both is good to half a per cent of it (steps down to 0.13)."""

FAR = 100.0
"""How far the sides are that stand for none, over those of the domain."""

FIRST_TORN = 0.4
"""Where the film is first thought to tear: distance downstream over that beside (a ball's: a third)."""

FILMS_A_DECADE = 10
"""Films for which the load that is squeezed beyond a domain is known."""

SETTLING = 50
"""Most changes of where the film is torn; two to eight are usual."""

NOTHING = 1e-10
"""Net inflow of a torn node, over the largest pressure, that is none."""


def missing_share(contact, x, y):
    """Part of a contact's load that is missing in a domain, its ends in m."""
    film, radii = _rigid_film(contact), (contact.radius_x, contact.radius_y)
    lengths = [sqrt(2.0 * radius * film) for radius in radii]
    ends = [_rounded(pair, length) for pair, length in zip((x, y), lengths, strict=True)]
    pressure = 12.0 * contact.lubricant.viscosity * contact.speed * lengths[0] / film**2
    missing = missing_load(*ends, lengths[0] / lengths[1], contact.motion, contact.held / pressure)
    share = missing * pressure * lengths[0] * lengths[1] / contact.load
    return max(-MOST, min(share, MOST))


def _rigid_film(contact):
    """h_0 in m: the film between the bodies as they are far outside, less what they yield in the middle."""
    film = THINNER * contact.flooded_film
    length = 2.0 * film * sqrt(contact.radius_x * contact.radius_y)
    yields = YIELDS * contact.load / (contact.likeness.reduced_modulus * sqrt(length))
    return max(film - yields, LEAST * film)


@lru_cache(maxsize=64)
def missing_load(x, y, ratio, motion, around=0.0):
    """The load missing between ends x and y in units of sqrt(2 R h_0), of a motion in these parts, or
    without one of an approach at a speed V. In units of 12 eta u sqrt(2 R_x h_0)/h_0^2, that of the
    pressure `around`, or of 24 eta V R_x/h_0^2, times both lengths; their `ratio` is that along x to y."""
    coarse, fine = (_missing_on(step, x, y, ratio, motion, around) for step in STEPS)
    limit = fine + (fine - coarse) / ((STEPS[0] / STEPS[1]) ** 2 - 1.0)
    falls = 1 if motion else 2  # the power of the distance with which the load beyond it does
    return limit / (1.0 - FAR**-falls)


def missing_by_squeeze(contact, x, y, film):
    """The same of bodies that approach each other, in N over their speed in m/s, where the film in the
    middle is so thick, in m. It hardly depends on that film: both that lie around it, of `FILMS_A_DECADE`,
    are looked up."""
    place = FILMS_A_DECADE * log10(film)
    below, part = floor(place), place - floor(place)
    at = (10.0 ** (each / FILMS_A_DECADE) for each in (below, below + 1))
    thin, thick = (_by_squeeze(contact, x, y, each) for each in at)
    return (1.0 - part) * thin + part * thick


def _by_squeeze(contact, x, y, film):
    """The same of a film that is looked up."""
    lengths = [sqrt(2.0 * radius * film) for radius in (contact.radius_x, contact.radius_y)]
    pressure = 24.0 * contact.lubricant.viscosity * contact.radius_x / film**2
    ends = (_rounded(pair, length) for pair, length in zip((x, y), lengths, strict=True))
    return missing_load(*ends, lengths[0] / lengths[1], None) * pressure * lengths[0] * lengths[1]


def _rounded(ends, length):
    """Two ends in units of a length, the same for what differs by rounding."""
    return tuple(round(end / length, 6) for end in ends)


def _missing_on(step, x, y, ratio, motion, around):
    """The same on one grid."""
    (X, of_x), (Y, of_y) = _nodes(x, step), _nodes(y, step)
    flow = _Reynolds(X, Y, ratio, motion)
    everywhere, domain = (np.zeros((Y.size, X.size), dtype=bool) for _ in range(2))
    everywhere[1:-1, 1:-1] = domain[of_y, of_x] = True
    return flow.load(everywhere, around) - flow.load(domain, around)


def _nodes(ends, step):
    """Nodes from far before to far behind the `ends`, which are two of them; and the slice between them."""
    before, behind, far = np.arcsinh((*ends, FAR * max(-ends[0], ends[1])))
    borders = (-far, before, behind, far)
    cells = [max(2, ceil((last - first) / step)) for first, last in pairwise(borders)]
    known = np.concatenate(([0], np.cumsum(cells)))
    nodes = np.sinh(np.interp(np.arange(known[-1] + 1), known, borders))
    return nodes, slice(known[1] + 1, known[2])


class _Reynolds:
    """Finite volumes of a rigid gap h = 1 + x^2 + y^2, whose film tears; without a motion it is squeezed,
    and does not. Between two nodes h changes a hundredfold, so a face has the flow of the line between
    them, by which the pressure of a flow q falls by q int h^-3 - int h^-2."""

    def __init__(self, X, Y, ratio, motion):
        cells_x, cells_y = _cells(X), _cells(Y)
        self._area = np.outer(cells_y, cells_x).ravel()
        number = np.arange(self._area.size).reshape(Y.size, X.size)
        eased_x, carried_x = _faces(X, Y)
        eased_y, carried_y = (each.T for each in _faces(Y, X))
        c, s = motion or (0.0, 0.0)
        sides = (
            (number[:, :-1], number[:, 1:], eased_x * cells_y[:, None], carried_x * c),
            (number[:-1], number[1:], eased_y * cells_x * ratio**2, carried_y * s / ratio),
        )
        w, e, eased, carried = (np.concatenate([side[k].ravel() for side in sides]) for k in range(4))
        entries = np.concatenate((-eased, -eased, eased, eased))
        matrix = coo_matrix((entries, (np.concatenate((w, e, w, e)), np.concatenate((e, w, w, e))))).tocsr()
        flow = eased * carried
        gained = np.bincount(e, flow, self._area.size) - np.bincount(w, flow, self._area.size)
        gained = gained if motion else self._area
        self._matrix, self._gained = diags(1.0 / matrix.diagonal()) @ matrix, gained / matrix.diagonal()
        along, across = (a * X + b * Y[:, None] for a, b in ((c, s), (-s, c)))
        self._film = (along < FIRST_TORN * np.hypot(1.0, across)).ravel()

    def load(self, inside, around):
        """The integral of p, which is 0 but `inside`, a mask (lines, nx), and tears at -`around`."""
        inside = inside.ravel()
        film = (self._film | (around > 0.0)) & inside
        for _ in range(SETTLING):
            p = np.where(inside, -around, 0.0)
            sucked = self._gained - self._matrix @ np.where(film, 0.0, p)
            p[film] = spsolve(self._matrix[film][:, film], sucked[film])
            net = self._gained - self._matrix @ p
            torn, fills = film & (p < -around), inside & ~film & (net > NOTHING * p.max())
            if not (torn | fills).any():
                break
            film = film & ~torn | fills
        return float(self._area @ np.maximum(p, -around))


def _cells(nodes):
    """Lengths of the cells around the nodes."""
    halves = 0.5 * np.diff(nodes)
    return np.append(halves, 0.0) + np.append(0.0, halves)


def _faces(nodes, lines):
    """1/int h^-3 and int h^-2 between neighbouring nodes, on all lines: (lines, nodes - 1) each."""

    def gap(at):
        return 1.0 + at**2 + lines[:, None] ** 2

    before, behind, cell = nodes[:-1], nodes[1:], np.diff(nodes)
    cubes, squares = (
        cell * (gap(before) ** -k + 4.0 * gap(0.5 * (before + behind)) ** -k + gap(behind) ** -k) / 6.0
        for k in (3, 2)
    )
    return 1.0 / cubes, squares
