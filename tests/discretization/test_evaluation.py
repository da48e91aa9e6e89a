import numpy as np
import pytest
from handmade import ghosted, walled
from test_status import neighbourhood, neighbourhoods

from mgehl.discretization.axes import own
from mgehl.discretization.couette import SCHEMES
from mgehl.discretization.evaluation import Evaluation
from mgehl.discretization.fluid import FACE_MOBILITIES
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme

every_mean = pytest.mark.parametrize("mean", FACE_MOBILITIES)

# Liu eqs. 31 and 32 as printed: Couette flow leaving node i and entering it.
LEAVING = {
    "1B": lambda r, H, i: r[i] * H[i],
    "2B": lambda r, H, i: (3 * r[i] * H[i] - r[i - 1] * H[i - 1]) / 2,
    "2C": lambda r, H, i: (r[i] * H[i] + r[i + 1] * H[i + 1]) / 2,
    "S1B": lambda r, H, i: r[i] * H[i] + (r[i] - r[i - 1]) * H[i],
    "S2C": lambda r, H, i: (
        (r[i] * H[i] + r[i + 1] * H[i + 1]) / 2 - (r[i + 1] - r[i]) * (H[i + 1] - H[i]) / 2
    ),
}
ENTERING = {
    "1B": lambda r, H, i: r[i - 1] * H[i - 1],
    "2B": lambda r, H, i: (3 * r[i - 1] * H[i - 1] - r[i - 2] * H[i - 2]) / 2,
    "2C": lambda r, H, i: (r[i] * H[i] + r[i - 1] * H[i - 1]) / 2,
    "S1B": lambda r, H, i: r[i - 1] * H[i - 1] + (r[i] - r[i - 1]) * H[i - 1],
    "S2C": lambda r, H, i: (
        (r[i] * H[i] + r[i - 1] * H[i - 1]) / 2 - (r[i] - r[i - 1]) * (H[i] - H[i - 1]) / 2
    ),
}


@neighbourhoods
@pytest.mark.parametrize("couette", LEAVING)
def test_net_inflow_of_each_neighbourhood(number, closed, couette, contact):
    """The four flows of Eq. 33 written out for one node, less those through its closed faces."""
    rng = np.random.default_rng(number)
    mesh = Mesh(5, 9, (-1.6, 1.4), (-1.5, 1.5), k_e=0.7)
    P, H = rng.uniform(0.1, 0.6, (3, 5)), rng.uniform(0.05, 0.15, (3, 5))
    status = walled(neighbourhood(closed))
    evaluation = Evaluation(ghosted(P), ghosted(H), status, mesh, contact, Scheme(couette))
    eps, rho, i = own(evaluation.fluid.eps), own(evaluation.fluid.rho), 2

    def poiseuille(here, there, spacing):
        return -0.5 * (eps[here] + eps[there]) * (P[there] - P[here]) / spacing

    # 2B and S1B do not reach across a closed west face: 2C and 1B serve the east one then.
    beside_contact = {"2B": "2C", "S1B": "1B"}.get(couette, couette)
    leaving = LEAVING[beside_contact if "west" in closed else couette]
    c, w, e, s, n = (1, 2), (1, 1), (1, 3), (0, 2), (2, 2)
    flows = {
        "west": (ENTERING[couette](rho[1], H[1], i) + poiseuille(w, c, mesh.dX)) / mesh.dX,
        "east": -(leaving(rho[1], H[1], i) + poiseuille(c, e, mesh.dX)) / mesh.dX,
        "south": 0.7**2 * poiseuille(s, c, mesh.dY) / mesh.dY,
        "north": -(0.7**2) * poiseuille(c, n, mesh.dY) / mesh.dY,
    }
    expected = sum(flow for face, flow in flows.items() if face not in closed)
    size = max(abs(flow) for flow in flows.values())
    assert evaluation.inflow.shape == (3, 5)
    assert evaluation.inflow[1, i] == pytest.approx(expected, rel=1e-12, abs=1e-13 * size)


PATCHES = [(slice(1, 4), slice(2, 6)), (slice(0, 5), slice(1, 7)), (slice(2, 3), slice(3, 4))]


def patch_imbalance(state, scheme, lines, nodes):
    """Sum of the inflow over a patch less the flow over its border, and the border's own size."""
    mesh, evaluation = state.mesh, state.evaluation(scheme)
    inside = evaluation.inflow[lines, nodes].sum() * mesh.dX * mesh.dY
    (leaving, entering), (out, into) = evaluation.flows
    border = (
        *(entering.value[lines, nodes.start - 1] * mesh.dY),
        *(-leaving.value[lines, nodes.stop - 1] * mesh.dY),
        *(into.value[lines.start, nodes] * mesh.dX),
        *(-out.value[lines.stop, nodes] * mesh.dX),
    )
    return inside - sum(border), sum(abs(flow) for flow in border)


@pytest.mark.parametrize("lines, nodes", PATCHES)
@every_mean
@pytest.mark.parametrize("couette", [name for name in SCHEMES if SCHEMES[name].conservative])
@pytest.mark.parametrize("motion", [(1.0, 0.0), (0.6, 0.8)], ids=["along x", "at an angle"])
def test_inflow_of_a_patch_is_the_flow_over_its_border(motion, couette, mean, lines, nodes, state):
    """Inner flows cancel in pairs, also around contact nodes inside the patch."""
    imbalance, size = patch_imbalance(state, Scheme(couette, mean, motion=motion), lines, nodes)
    assert abs(imbalance) <= 1e-13 * size


def test_S1B_loses_fluid_inside_a_patch_by_the_extra_term_of_eq_12(film):
    """Each inner face swallows (rho_E - rho_W) H_W less (rho_W - rho_WW) H_W of what leaves."""
    lines, nodes = PATCHES[0]
    imbalance, _ = patch_imbalance(film, Scheme("S1B"), lines, nodes)
    rho, H = own(film.evaluation().fluid.rho), own(film.H)
    west = np.arange(nodes.start, nodes.stop - 1)
    second = rho[lines, west + 1] - 2.0 * rho[lines, west] + rho[lines, west - 1]
    assert imbalance == pytest.approx((second * H[lines, west]).sum() * film.mesh.dY, rel=1e-9)
    assert abs(imbalance) > 1e-5
