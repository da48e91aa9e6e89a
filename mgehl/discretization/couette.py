"""The Couette flow through a face by every differential scheme  [Liu eqs. 9-14, 17, 18, 31, 32].

Each is a sum of products c rho_a H_b over the nodes a, b near the face: W and E on its two sides, WW beyond
W and EE beyond E; H is what lies above adsorbed layers. Value and linearisation come from the same table.
"""

from dataclasses import dataclass, replace
from math import inf, isfinite

import numpy as np

from mgehl.discretization.flow import EE, SHIFT, WW, E, Flow, W


@dataclass(frozen=True)
class CouetteScheme:
    """Terms (c, a, b) of the flow c rho_a H_b that leaves W and that enters E: the same where the scheme is
    a difference of rho H, not where these are differenced apart (Eq. 12). `near` serves faces whose node WW
    or EE is not there, or is solid: nothing is extrapolated across an interface."""

    leaving: tuple
    entering: tuple
    order: int
    """Of its d(rho H)/dx away from walls: exact for products x^m of rho and x^n of H, m + n <= order. The
    bands about films are by it."""
    near: tuple = ()
    limit: float = inf
    """By how much of 1B's flow the flow may differ from that."""

    @property
    def conservative(self):
        return self.leaving == self.entering

    @property
    def is_central(self):
        """Whether the flow is of the two nodes beside the face, alike."""
        return nodes_of(self.leaving) == {W, E}

    def limited(self):
        """The same within 3L's limit."""
        return self if self.leaving == _1B else replace(self, limit=min(self.limit, _HALF))


_1B = ((1.0, W, W),)
_2B = ((1.5, W, W), (-0.5, WW, WW))
_2C = ((0.5, W, W), (0.5, E, E))
_3B = ((2 / 6, E, E), (5 / 6, W, W), (-1 / 6, WW, WW))
"""Third order, upwind biased."""
_HALF = 0.5
"""Limit of 3L. Behind a peak the film falls to nothing, and 3B would carry away more than there is; below 1
the flow ends with the node's film. A monotone limiter would cut the crest of every wave."""
_S1B_LEAVING = ((2.0, W, W), (-1.0, WW, W))
_S1B_ENTERING = ((1.0, E, W),)
_S2C = ((0.5, W, E), (0.5, E, W))


def _apart(centre, sides):
    """2B of rho and of H apart: H_m rho_f + rho_m H_f - rho_i H_i at node i = `centre`.

    Of [Liu sec. 3.1, (v), (vi)], f is the 2B value at the face, (3 q_W - q_WW)/2; m the mean over `sides`.
    The last product, in both, makes each of them a flow: where rho = 1 it is the 2B face value of H.
    """
    face = ((1.5, W), (-0.5, WW))
    share = 1.0 / len(sides)
    terms = [(share * c, f, m) for c, f in face for m in sides]
    terms += [(share * c, m, f) for c, f in face for m in sides]
    return (*terms, (-1.0, centre, centre))


# 2B without WW: rho H extrapolated linearly from W and E to WW gives 2C, and the first interior
# node then sees exactly the 1B difference. The same for rho and H apart gives S2C. Put into 3B it gives
# 2C, too.
SCHEMES = {
    "1B": CouetteScheme(_1B, _1B, 1),
    "2B": CouetteScheme(_2B, _2B, 2, near=_2C),
    "2C": CouetteScheme(_2C, _2C, 2),
    "3B": CouetteScheme(_3B, _3B, 3, near=_2C),
    "3L": CouetteScheme(_3B, _3B, 3, near=_2C, limit=_HALF),
    "S1B": CouetteScheme(_S1B_LEAVING, _S1B_ENTERING, 1, near=_1B),
    "S2C": CouetteScheme(_S2C, _S2C, 2),
    "S2B-v": CouetteScheme(_apart(W, (WW, E)), _apart(E, (W, EE)), 2, near=_S2C),
    "S2B-vi": CouetteScheme(_apart(W, (W,)), _apart(E, (E,)), 2, near=_S2C),
}
"""S2B-v and S2B-vi: rho and H apart with 2B, their other factor the mean of i - 1 and i + 1, or at i."""


def couette_scheme(name, coarsenings=0):
    """The `CouetteScheme` of a name; on a grid `coarsenings` times coarser one with about the same error:
    half of a first-order scheme on the next, a quarter after that, the rest of third order."""
    scheme = SCHEMES[name]
    if coarsenings == 0:
        return scheme
    share = 0.5**coarsenings
    near = _blended(scheme.near or scheme.leaving, _2C, share)
    leaving, entering = _blended(scheme.leaving, _3B, share), _blended(scheme.entering, _3B, share)
    return replace(scheme, leaving=leaving, entering=entering, near=near)


def _blended(terms, others, share):
    """Terms of `share` of a flow and the rest of another."""
    return (*((share * c, a, b) for c, a, b in terms), *(((1.0 - share) * c, a, b) for c, a, b in others))


def nodes_of(terms):
    """Node positions at which a flow depends on pressure or gap."""
    return {node for _, a, b in terms for node in (a, b)}


@dataclass(frozen=True)
class Part:
    """The products `terms` through the faces first ... last - 1, a `share` of them at each face."""

    terms: tuple
    first: int
    last: int
    share: float | np.ndarray = 1.0

    def where(self, faces, axis):
        """The part at those faces alone where the mask `faces`, of all faces, is True."""
        return replace(self, share=self.share * axis.of_faces(faces, self.first, self.last))


def add_couette(flow, terms, scheme, fluid, solid, axis):
    """Add to `flow` through the faces along an axis the Couette flow by `terms` of a `CouetteScheme`, its
    products `near` where a far node is solid or not there. `fluid` and `solid` are ghosted."""
    parts = _parts(terms, scheme.near, solid, axis)
    if isfinite(scheme.limit):
        parts = _within(scheme.limit, parts, fluid, axis)
    for part in parts:
        _add_products(flow, part, fluid, axis, axis.couette)


def _parts(terms, near, solid, axis):
    """The `Part`s that make up the flow."""
    far = nodes_of(terms) & {WW, EE}
    first, last = axis.reachable(solid, [SHIFT[node] for node in far])
    ends = [Part(near, 0, first), Part(near, last, axis.faces(solid))]
    blocked = [axis.at(solid, SHIFT[node], first, last) for node in sorted(far)]
    if not any(each.any() for each in blocked):
        return [*ends, Part(terms, first, last)]
    beside = np.logical_or.reduce(blocked)
    return [*ends, Part(terms, first, last, ~beside), Part(near, first, last, beside)]


def _within(limit, parts, fluid, axis):
    """The parts of a flow that is to differ from 1B's by no more than a `limit` of it. Where it would, 1B's
    flow times 1 - limit or 1 + limit takes its place, with its derivatives."""
    least, most = 1.0 - limit, 1.0 + limit
    upstream = axis.at(fluid.rho) * axis.at(fluid.carried)
    carried = Flow(upstream.shape)
    for part in parts:
        _add_products(carried, part, fluid, axis, velocity=1.0)
    too_much = carried.value > most * upstream
    too_little = (carried.value < least * upstream) & ~too_much
    limited = too_much | too_little
    if not limited.any():
        return parts
    of_upstream = Part(_1B, 0, axis.faces(fluid.rho), most * too_much + least * too_little)
    return [*(part.where(~limited, axis) for part in parts), of_upstream]


def _add_products(flow, part, fluid, axis, velocity):
    """Add `velocity` times the products c rho_a H_b of a part, with the derivatives that `flow` has."""
    first, last = part.first, part.last

    def here(array):
        return axis.of_faces(array, first, last)

    for c, a, b in part.terms if first < last else ():
        rho, H = axis.at(fluid.rho, SHIFT[a], first, last), axis.at(fluid.carried, SHIFT[b], first, last)
        signed = c * (velocity * part.share)
        here(flow.value)[:] += signed * rho * H
        if flow.by_P:
            here(flow.by_P[a])[:] += signed * axis.at(fluid.drho_dP, SHIFT[a], first, last) * H
        if flow.by_H:
            by_H = signed * rho
            if fluid.follows is not None:
                by_H = by_H * axis.at(fluid.follows, SHIFT[b], first, last)
            here(flow.by_H[b])[:] += by_H
