from types import SimpleNamespace

import numpy as np
import pytest
from handmade import ALONG, Row

from mgehl.discretization.couette import SCHEMES, add_couette
from mgehl.discretization.flow import EE, SHIFT, WW, E, Flow, W
from mgehl.discretization.status import CONTACT, LUBRICATED, is_solid

# One row of five nodes with small whole numbers, so that every flow is exact.
RHO = np.array([2.0, 3.0, 5.0, 4.0, 7.0])
GAP = np.array([7.0, 11.0, 13.0, 6.0, 2.0])
SLOPE = np.array([1.0, 4.0, 2.0, 5.0, 3.0])
FILM = np.full(5, LUBRICATED)


@pytest.fixture(params=ALONG)
def couette_flows(request):
    """Function: flows that leave W and enter E along X, then along Y, each a `Flow` of the row's faces."""
    row = Row(request.param)

    def make(scheme, linearised=False, rho=RHO, gap=GAP, status=FILM, velocity=1.0):
        laid = {"rho": row.lay(rho), "carried": row.lay(gap), "drho_dP": row.lay(SLOPE)}
        fluid = SimpleNamespace(**laid, follows=None, torn=None, filling=None)
        solid, axis, table = is_solid(row.status(status)), row.axis(couette=velocity), SCHEMES[scheme]
        shape, flows = axis.at(solid).shape, []
        for terms in (table.leaving, table.entering):
            flow = Flow(shape, (WW, W, E, EE) if linearised else ())
            add_couette(flow, terms, table, fluid, solid, axis)
            flow.value = row.faces(flow.value)
            for derivatives in (flow.by_P, flow.by_H):
                derivatives |= {node: row.faces(array) for node, array in derivatives.items()}
            flows.append(flow)
        return flows

    return make


@pytest.mark.parametrize(
    "scheme, flow",
    [("2B", 49.0), ("3B", 49.0), ("3L", 49.0), ("S2B-v", 47.0), ("S2B-vi", 47.0), ("S1B", 33.0)],
)
def test_nothing_is_extrapolated_from_the_far_side_of_a_contact(couette_flows, scheme, flow):
    """With node 0 solid, the face between nodes 1 and 2 uses 2C, S2C or 1B of these two nodes."""
    leaving, _ = couette_flows(scheme, status=[CONTACT, *FILM[1:]])
    assert leaving.value[1] == pytest.approx(flow, rel=1e-14)
    free, _ = couette_flows(scheme)
    assert leaving.value[1] != free.value[1]
    assert leaving.value[2] == free.value[2]


# Through the face between nodes 1 and 2, WW, W, E: by 3B (5 W + 2 E - WW)/6. The first may be carried.
@pytest.mark.parametrize(
    "gap, by_3B, by_3L",
    [
        ([6.0, 6.0, 12.0], 8.0, 8.0),
        ([0.0, 6.0, 30.0], 15.0, 9.0),  # the film grows: half as much again as that of W
        ([30.0, 6.0, 3.0], 1.0, 3.0),  # it falls: half of it
        ([6.0, 0.0, 18.0], 5.0, 0.0),  # a node without a film hands nothing on
        ([6.0, 0.0, 0.0], -1.0, 0.0),
    ],
)
def test_3L_differs_from_the_film_of_the_node_upstream_by_half_of_it(couette_flows, gap, by_3B, by_3L):
    row = {"rho": np.ones(5), "gap": np.array([*gap, 0.0, 0.0])}
    assert couette_flows("3B", **row)[0].value[1] == pytest.approx(by_3B, rel=1e-15)
    for velocity in (1.0, -2.0):
        flow = couette_flows("3L", **row, velocity=velocity)[0].value[1]
        assert flow == pytest.approx(velocity * by_3L, rel=1e-15)


@pytest.mark.parametrize("name", SCHEMES)
def test_the_order_is_that_of_the_products_that_are_differenced_exactly(name):
    scheme = SCHEMES[name]

    def is_exact(m, n):
        """Whether the difference of rho = x^m and H = x^n is right at x = 0, the spacing 1."""
        leaving = sum(c * SHIFT[a] ** m * SHIFT[b] ** n for c, a, b in scheme.leaving)
        entering = sum(c * (SHIFT[a] - 1) ** m * (SHIFT[b] - 1) ** n for c, a, b in scheme.entering)
        return leaving - entering == pytest.approx(m + n == 1, abs=1e-12)

    exact = [all(is_exact(m, degree - m) for m in range(degree + 1)) for degree in range(1, 5)]
    assert exact.index(False) == scheme.order
