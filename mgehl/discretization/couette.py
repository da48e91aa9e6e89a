"""The Couette flow through a face by every differential scheme  [Liu eqs. 17, 18, 31, 32].

Each scheme is a sum of products c rho_a H_b over the nodes a, b near the face: W and E on its
two sides, WW upstream of W. Value and linearisation come from the same table.
"""

from dataclasses import dataclass

WW, W, E = 0, 1, 2
"""Node positions relative to the face between W and E."""

_SHIFT = {WW: -1, W: 0, E: 1}


@dataclass(frozen=True)
class CouetteScheme:
    """Terms (c, a, b) of the flow c rho_a H_b that leaves W and that enters E.

    The two are the same flow in every scheme but S1B, which is not conservative: Eq. 12 has one
    term more than Eq. 8. `first` serves the first face of a line, which has no WW node.
    """

    leaving: tuple
    entering: tuple
    first: tuple | None = None

    @property
    def conservative(self):
        return self.leaving == self.entering


_1B = ((1.0, W, W),)
_2B = ((1.5, W, W), (-0.5, WW, WW))
_2C = ((0.5, W, W), (0.5, E, E))
_S2C = ((0.5, W, E), (0.5, E, W))
_S1B_LEAVING = ((2.0, W, W), (-1.0, WW, W))
_S1B_ENTERING = ((1.0, E, W),)

# 2B at the first face: rho H extrapolated linearly from W and E to WW gives 2C, and the first
# interior node then sees exactly the 1B difference.
SCHEMES = {
    "1B": CouetteScheme(_1B, _1B),
    "2B": CouetteScheme(_2B, _2B, first=_2C),
    "2C": CouetteScheme(_2C, _2C),
    "S1B": CouetteScheme(_S1B_LEAVING, _S1B_ENTERING, first=_S1B_ENTERING),
    "S2C": CouetteScheme(_S2C, _S2C),
}


def add_couette(leaving, entering, fluid, scheme):
    """Add the Couette flow of `fluid` (lines, nx) to two flows through the x faces.

    `leaving` and `entering` are `Flow` objects of shape (lines, nx - 1), one and the same object
    where the scheme is conservative.
    """
    table = SCHEMES[scheme]
    _add_terms(leaving, table.leaving, table.first, fluid)
    if entering is not leaving:
        _add_terms(entering, table.entering, table.first, fluid)


def _add_terms(flow, terms, first, fluid):
    faces = flow.value.shape[1]
    if first is None:
        _add_products(flow, terms, fluid, 0, faces)
    else:
        _add_products(flow, first, fluid, 0, 1)
        _add_products(flow, terms, fluid, 1, faces)


def _add_products(flow, terms, fluid, start, stop):
    """Add c rho_a H_b through the faces start..stop-1, with its derivatives if asked for."""
    for c, a, b in terms:
        at_a = slice(start + _SHIFT[a], stop + _SHIFT[a])
        at_b = slice(start + _SHIFT[b], stop + _SHIFT[b])
        rho, H = fluid.rho[:, at_a], fluid.H[:, at_b]
        flow.value[:, start:stop] += c * rho * H
        if flow.linearised:
            flow.by_P[a][:, start:stop] += c * fluid.drho_dP[:, at_a] * H
            flow.by_H[b][:, start:stop] += c * rho
