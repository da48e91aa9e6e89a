import numpy as np
import pytest
from dense import dense_stencil
from test_status import neighbourhood, neighbourhoods

from mgehl.discretization.couette import SCHEMES
from mgehl.discretization.faces import x_flows, y_flows
from mgehl.discretization.fluid import FACE_MEANS, fluid_state
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.residual import C, linearise, net_inflow, residual
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED

every_scheme = pytest.mark.parametrize("couette", SCHEMES)
every_mean = pytest.mark.parametrize("mean", FACE_MEANS)

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
    status = neighbourhood(closed)
    fluid = fluid_state(P, H, contact)
    eps, i = fluid.eps, 2

    def poiseuille(here, there, spacing):
        return -0.5 * (eps[here] + eps[there]) * (P[there] - P[here]) / spacing

    # 2B and S1B do not reach across a closed west face: 2C and 1B serve the east one then.
    beside_contact = {"2B": "2C", "S1B": "1B"}.get(couette, couette)
    leaving = LEAVING[beside_contact if "west" in closed else couette]
    c, w, e, s, n = (1, 2), (1, 1), (1, 3), (0, 2), (2, 2)
    flows = {
        "west": (ENTERING[couette](fluid.rho[1], H[1], i) + poiseuille(w, c, mesh.dX)) / mesh.dX,
        "east": -(leaving(fluid.rho[1], H[1], i) + poiseuille(c, e, mesh.dX)) / mesh.dX,
        "south": 0.7**2 * poiseuille(s, c, mesh.dY) / mesh.dY,
        "north": -(0.7**2) * poiseuille(c, n, mesh.dY) / mesh.dY,
    }
    expected = sum(flow for face, flow in flows.items() if face not in closed)
    inflow = net_inflow(P, H, status, mesh, contact, Scheme(couette))
    assert inflow.shape == (1, 5)
    size = max(abs(flow) for flow in flows.values())
    assert inflow[0, i] == pytest.approx(expected, rel=1e-12, abs=1e-13 * size)


def test_node_with_four_closed_faces_gets_nothing(contact):
    status = neighbourhood({"west", "east", "south", "north"})
    P, H = np.linspace(0.1, 0.6, 15).reshape(3, 5), np.full((3, 5), 0.1)
    mesh = Mesh(5, 9, (-1.6, 1.4), (-1.5, 1.5))
    assert net_inflow(P, H, status, mesh, contact, Scheme())[0, 2] == 0.0


def test_line_ends_get_no_inflow(film, contact):
    inflow = net_inflow(film.P, film.H, film.status, film.mesh, contact, Scheme())
    assert inflow.shape == (5, 8)
    assert not inflow[:, [0, -1]].any()
    assert inflow[:, 1:-1].all()


PATCHES = [(slice(1, 4), slice(2, 6)), (slice(0, 5), slice(1, 7)), (slice(2, 3), slice(3, 4))]


def patch_imbalance(state, contact, couette, mean, lines, nodes):
    """Sum of the inflow over a patch less the flow over its border, and the border's own size."""
    mesh, scheme = state.mesh, Scheme(couette, mean)
    inflow = net_inflow(state.P, state.H, state.status, mesh, contact, scheme)
    inside = inflow[lines, nodes].sum() * mesh.dX * mesh.dY
    fluid = fluid_state(state.P, state.H, contact)
    leaving, entering = x_flows(fluid[1:-1], state.status[1:-1], mesh, scheme)
    across = y_flows(fluid, state.status, mesh, scheme).value
    border = (
        *(entering.value[lines, nodes.start - 1] * mesh.dY),
        *(-leaving.value[lines, nodes.stop - 1] * mesh.dY),
        *(across[lines.start, nodes] * mesh.dX),
        *(-across[lines.stop, nodes] * mesh.dX),
    )
    return inside - sum(border), sum(abs(flow) for flow in border)


@pytest.mark.parametrize("lines, nodes", PATCHES)
@every_mean
@pytest.mark.parametrize("couette", [name for name in SCHEMES if SCHEMES[name].conservative])
def test_inflow_of_a_patch_is_the_flow_over_its_border(couette, mean, lines, nodes, state, contact):
    """Inner flows cancel in pairs, also around contact nodes inside the patch."""
    imbalance, size = patch_imbalance(state, contact, couette, mean, lines, nodes)
    assert abs(imbalance) <= 1e-13 * size


def test_S1B_loses_fluid_inside_a_patch_by_the_extra_term_of_eq_12(film, contact):
    """Each inner face swallows (rho_E - rho_W) H_W less (rho_W - rho_WW) H_W of what leaves."""
    lines, nodes = PATCHES[0]
    imbalance, _ = patch_imbalance(film, contact, "S1B", "arithmetic", lines, nodes)
    rho, H = fluid_state(film.P, film.H, contact).rho[1:-1], film.H[1:-1]
    west = np.arange(nodes.start, nodes.stop - 1)
    second = rho[lines, west + 1] - 2.0 * rho[lines, west] + rho[lines, west - 1]
    assert imbalance == pytest.approx((second * H[lines, west]).sum() * film.mesh.dY, rel=1e-9)
    assert abs(imbalance) > 1e-5


def test_residual_has_one_row_for_each_status():
    status = np.array([[BOUNDARY, LUBRICATED, CAVITATED, CONTACT]])
    P, H = np.array([[1.0, 2.0, 3.0, 4.0]]), np.array([[5.0, 6.0, 7.0, 8.0]])
    inflow = np.array([[0.0, 9.0, 10.0, 11.0]])
    mesh = Mesh(5, 5, (-1.0, 1.0), (-1.0, 1.0))
    assert residual(inflow, P, H, status, mesh).tolist() == [[-2.0, 9.0, -6.0, -16.0]]


def central_differences(function, x, d):
    columns = []
    for node in np.ndindex(*x.shape):
        above, below = x.copy(), x.copy()
        above[node] += d
        below[node] -= d
        columns.append((function(above) - function(below)).ravel() / (2.0 * d))
    return np.array(columns).T


@pytest.mark.parametrize("rigid", [False, True], ids=["deformable", "rigid"])
@every_mean
@every_scheme
def test_linearisation_matches_central_differences(couette, mean, rigid, state, contact):
    """A and B hold every derivative of the residual, and nothing else."""
    P, H, status, mesh = state.P, state.H, state.status, state.mesh
    scheme = Scheme(couette, mean)

    def rows(P, H):
        inflow = net_inflow(P, H, status, mesh, contact, scheme)
        F = residual(inflow, P[1:-1], H[1:-1], status[1:-1], mesh)
        if rigid:
            F = np.where(status[1:-1] == CONTACT, -P[1:-1] / mesh.dX, F)
        return F

    linear = linearise(P, H, status, mesh, contact, scheme, rigid)
    by_P = central_differences(lambda changed: rows(changed, H), P, 1e-6)
    by_H = central_differences(lambda changed: rows(P, changed), H, 1e-7)
    assert (linear.B is None) == rigid
    for stencil, measured in ((linear.A, by_P),) if rigid else ((linear.A, by_P), (linear.B, by_H)):
        scale = np.abs(stencil).max()
        np.testing.assert_allclose(dense_stencil(stencil), measured, rtol=1e-6, atol=1e-8 * scale)


def test_linearised_rows_of_given_nodes(mixed, contact):
    """Boundary and cavitated rows are -P/dX, contact rows -H/dX or, at a rigid gap, -P/dX."""
    status, mesh = mixed.status[1:-1], mixed.mesh
    for rigid in (False, True):
        linear = linearise(mixed.P, mixed.H, mixed.status, mesh, contact, Scheme(), rigid)
        pressures = (status == BOUNDARY) | (status == CAVITATED) | ((status == CONTACT) & rigid)
        gaps = [] if rigid else [(linear.B, status == CONTACT)]
        for stencil, rows in ((linear.A, pressures), *gaps):
            given = status != LUBRICATED
            assert (stencil[2][rows] == -1.0 / mesh.dX).all()
            assert not stencil[2][given & ~rows].any()
            assert not stencil[[0, 1, 3, 4, 5]][:, given].any()


@pytest.mark.parametrize("rigid", [False, True], ids=["deformable", "rigid"])
@pytest.mark.parametrize("rate", [0.3, 40.0, "each its own"])
def test_squeeze_adds_the_rate_of_rho_H_to_film_nodes_and_to_nothing_else(rate, rigid, state, contact):
    """-rate d(rho H)/dP and -rate rho at the centre of lubricated nodes."""
    inner = state.P[1:-1].shape
    rate = np.arange(1.0, 1.0 + state.P[1:-1].size).reshape(inner) if rate == "each its own" else rate
    rates = np.broadcast_to(rate, inner)
    arguments = state.P, state.H, state.status, state.mesh, contact, Scheme(), rigid
    steady, implicit = linearise(*arguments), linearise(*arguments, squeeze=rate)
    P, H, film, d = state.P[1:-1], state.H[1:-1], state.status[1:-1] == LUBRICATED, 1e-6
    above, rho, below = (fluid_state(P + s * d, H, contact).rho for s in (1.0, 0.0, -1.0))
    by_H = [] if rigid else [(steady.B, implicit.B, rho)]
    for before, after, rate_of in ((steady.A, implicit.A, (above - below) * H / (2.0 * d)), *by_H):
        added, size = after[C] - before[C], np.abs(before[C]).max()
        np.testing.assert_allclose(added[film], -rates[film] * rate_of[film], rtol=1e-8, atol=1e-14 * size)
        np.testing.assert_array_equal(after[C][~film], before[C][~film])
        beside = [position for position in range(6) if position != C]
        np.testing.assert_array_equal(after[beside], before[beside])


def test_residual_of_a_rigid_gap_gives_the_pressure_of_contact_too():
    """Row -P/dX, whatever the gap; all other rows are those of a deformable one."""
    status = np.array([[BOUNDARY, LUBRICATED, CAVITATED, CONTACT]])
    P, H = np.array([[1.0, 2.0, 3.0, 4.0]]), np.array([[5.0, 6.0, 7.0, 8.0]])
    inflow = np.array([[0.0, 9.0, 10.0, 11.0]])
    mesh = Mesh(5, 5, (-1.0, 1.0), (-1.0, 1.0))
    assert residual(inflow, P, H, status, mesh, rigid=True).tolist() == [[-2.0, 9.0, -6.0, -8.0]]


OPTIONS = {
    "untreated": {"couette_at_interface": "untreated"},
    "against": {"motion": -1},
    "floor": {"gap_floor": 0.1},
    "unified": {"couette_at_interface": "untreated", "motion": -1, "gap_floor": 0.1},
}


@pytest.mark.parametrize("rigid", [False, True], ids=["deformable", "rigid"])
@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
@every_scheme
def test_linearisation_of_options_matches_central_differences(couette, options, rigid, mixed, contact):
    P, H, status, mesh = mixed.P, mixed.H, mixed.status, mixed.mesh
    scheme = Scheme(couette, **options)

    def rows(P, H):
        inflow = net_inflow(P, H, status, mesh, contact, scheme)
        return residual(inflow, P[1:-1], H[1:-1], status[1:-1], mesh, rigid)

    linear = linearise(P, H, status, mesh, contact, scheme, rigid)
    by_P = central_differences(lambda changed: rows(changed, H), P, 1e-6)
    by_H = central_differences(lambda changed: rows(P, changed), H, 1e-7)
    assert (linear.B is None) == rigid
    for stencil, measured in ((linear.A, by_P),) if rigid else ((linear.A, by_P), (linear.B, by_H)):
        scale = np.abs(stencil).max()
        np.testing.assert_allclose(dense_stencil(stencil), measured, rtol=1e-6, atol=1e-8 * scale)


def test_nothing_crosses_the_walls_of_a_single_line(contact):
    """Contact in the ghost lines: all inflow is along the line, whatever pressure lies beyond."""
    mesh = Mesh(8, 1, (-1.9, 1.3), (0.0, 0.0))
    rng = np.random.default_rng(2)
    P, H = rng.uniform(0.2, 0.8, (3, 8)), rng.uniform(0.05, 0.15, (3, 8))
    status = np.full((3, 8), LUBRICATED)
    status[[0, -1]] = CONTACT
    inflow = net_inflow(P, H, status, mesh, contact, Scheme())
    leaving, entering = x_flows(fluid_state(P, H, contact)[1:-1], status[1:-1], mesh, Scheme())
    along = (entering.value[:, :-1] - leaving.value[:, 1:]) / mesh.dX
    np.testing.assert_array_equal(inflow[:, 1:-1], along)
    linear = linearise(P, H, status, mesh, contact, Scheme())
    assert not linear.A[4:].any() and not linear.B[4:].any()
