import numpy as np
import pytest
from dense import dense_K, dense_Q, dense_stencil, held_beyond, line_stencils

from mgehl.discretization.bands import influence_of_columns
from mgehl.discretization.faces import x_flows, y_flows
from mgehl.discretization.fluid import fluid_state
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.kernels import (
    REACH,
    apply_jacobian,
    apply_stencil,
    build_bands,
    distribute,
    factor_bands,
    flow_sources,
    relax_cavitation,
    solve_bands,
)
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.residual import linearise, net_inflow
from mgehl.discretization.scheme import Scheme
from mgehl.model.deformation import HalfSpace


@pytest.fixture
def rng():
    return np.random.default_rng(11)


def test_apply_jacobian(rng):
    """out = A dP + B (dH + dH0) against dense matrices."""
    lines, nx = 4, 7
    A, B = line_stencils(rng, lines, nx)
    dP, dH = rng.standard_normal((2, lines + 2, nx))
    out = np.full((lines, nx), np.nan)
    apply_jacobian(A, B, dP, dH, 0.3, out)
    expected = dense_stencil(A) @ dP.ravel() + dense_stencil(B) @ (dH + 0.3).ravel()
    np.testing.assert_allclose(out.ravel(), expected, rtol=1e-13, atol=1e-13)


def test_apply_stencil(rng):
    lines, nx = 4, 7
    A, _ = line_stencils(rng, lines, nx)
    dP, out = rng.standard_normal((lines + 2, nx)), np.full((lines, nx), np.nan)
    apply_stencil(A, dP, out)
    np.testing.assert_allclose(out.ravel(), dense_stencil(A) @ dP.ravel(), rtol=1e-13, atol=1e-13)


@pytest.mark.parametrize("couette", ["1B", "2B", "2C", "S1B", "S2C"])
def test_apply_jacobian_predicts_the_change_of_the_inflow(couette, mixed, contact, rng):
    """A small step in P and H changes the inflow of lubricated nodes by J times the step."""
    P, H, status, mesh = mixed.P, mixed.H, mixed.status, mixed.mesh
    dP, dH, d = rng.standard_normal(P.shape), 0.1 * rng.standard_normal(P.shape), 1e-6
    scheme = Scheme(couette)
    linear = linearise(P, H, status, mesh, contact, scheme)
    out = np.empty((P.shape[0] - 2, P.shape[1]))
    apply_jacobian(linear.A, linear.B, dP, dH, 0.02, out)
    above = net_inflow(P + d * dP, H + d * (dH + 0.02), status, mesh, contact, scheme)
    below = net_inflow(P - d * dP, H - d * (dH + 0.02), status, mesh, contact, scheme)
    film = status[1:-1] == 1
    measured = (above - below)[film] / (2.0 * d)
    np.testing.assert_allclose(out[film], measured, rtol=1e-6, atol=1e-8 * np.abs(measured).max())


@pytest.mark.parametrize("distributed", [0.0, 0.5, 1.0], ids=["identity", "partly", "all"])
@pytest.mark.parametrize("k_e, share", [(1.0, 0.25), (0.6, 0.25), (0.6, 0.5)])
def test_build_bands_is_the_band_of_J_Q(distributed, k_e, share, rng):
    """Entry (i, m) of each line is that of (A + B K) Q with dense K and Q, up to REACH nodes away."""
    mesh = Mesh(15, 11, (-1.9, 1.3), (-1.5, 1.5), k_e)
    lines, nx = 3, mesh.nx
    K = influence_coefficients(mesh, HalfSpace(0.2))
    A, B = line_stencils(rng, lines, nx)
    distributive = rng.random((lines, nx)) < distributed
    # A line's ends are given; their column would reach outside the domain.
    distributive[:, [0, -1]] = False
    bands = np.full((lines, nx, 2 * REACH + 1), np.nan)
    build_bands(A, B, distributive, influence_of_columns(K, share), share, bands)
    Q = dense_Q(distributive, share)
    K_Q = held_beyond(dense_K(K, lines + 2, nx) @ Q, lines, nx, REACH)
    JQ = (dense_stencil(A) @ Q + dense_stencil(B) @ K_Q).reshape(lines, nx, lines, nx)
    expected = np.zeros_like(bands)
    for j, i, k in np.ndindex(*bands.shape):
        if 0 <= i + k - REACH < nx:
            expected[j, i, k] = JQ[j, i, j, i + k - REACH]
    np.testing.assert_allclose(bands, expected, rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("nx", [2, 5, 6, 23])
def test_banded_solve_against_dense(nx, rng):
    """Lines shorter and longer than the band; what a band holds outside the line is ignored."""
    lines = 3
    bands = rng.standard_normal((lines, nx, 2 * REACH + 1))
    bands[:, :, REACH] += 12.0
    dense = np.zeros((lines, nx, nx))
    for j, i, k in np.ndindex(*bands.shape):
        if 0 <= i + k - REACH < nx:
            dense[j, i, i + k - REACH] = bands[j, i, k]
        else:
            bands[j, i, k] = np.nan
    r, w = rng.standard_normal((lines, nx)), np.full((lines, nx), np.nan)
    factor_bands(bands)
    solve_bands(bands, r, w)
    expected = [np.linalg.solve(matrix, line) for matrix, line in zip(dense, r, strict=True)]
    np.testing.assert_allclose(w, expected, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("share", [0.25, 0.5])
def test_distribute(share, rng):
    """omega Q w against the dense Q of all ghosted lines."""
    lines, nx, omega = 4, 7, 0.8
    w, distributive = rng.standard_normal((lines + 2, nx)), rng.random((lines + 2, nx)) < 0.5
    out = np.full((lines, nx), np.nan)
    distribute(w, distributive, share, omega, out)
    expected = omega * (dense_Q(distributive, share) @ w.ravel()).reshape(lines + 4, nx)[2:-2]
    np.testing.assert_allclose(out, expected, rtol=1e-14, atol=1e-15)


def poiseuille_inflow(P, along, across):
    """L P of ghosted P in plain numpy, (lines, nx - 2)."""
    x = along * np.diff(P[1:-1], axis=1)
    y = across * np.diff(P, axis=0)
    return np.diff(x, axis=1) + np.diff(y, axis=0)[:, 1:-1]


def conductances(rng, lines, nx, closed=0.0):
    along, across = rng.uniform(0.2, 2.0, (lines, nx - 1)), rng.uniform(0.2, 2.0, (lines + 1, nx))
    along[rng.random(along.shape) < closed] = 0.0
    return along, across


def test_flow_sources(rng):
    """Inflow less L P at inner nodes; line ends keep what they had."""
    lines, nx = 4, 7
    P, inflow = rng.standard_normal((lines + 2, nx)), rng.standard_normal((lines, nx))
    along, across = conductances(rng, lines, nx)
    source = np.full((lines, nx), 5.0)
    flow_sources(inflow, P, along, across, source)
    expected = inflow[:, 1:-1] - poiseuille_inflow(P, along, across)
    np.testing.assert_allclose(source[:, 1:-1], expected, rtol=1e-13, atol=1e-13)
    assert (source[:, [0, -1]] == 5.0).all()


def test_flow_sources_leave_the_couette_flow_alone(film, contact):
    """With the faces' own conductances the source is the net inflow of the Couette flow."""
    P, H, status, mesh = film.P, film.H, film.status, film.mesh
    fluid = fluid_state(P, H, contact)
    eps = fluid.eps
    along = 0.5 * (eps[1:-1, :-1] + eps[1:-1, 1:]) / mesh.dX**2
    across = 0.5 * (eps[:-1] + eps[1:]) * (mesh.k_e / mesh.dY) ** 2
    source = np.zeros((5, 8))
    flow_sources(net_inflow(P, H, status, mesh, contact, Scheme()), P, along, across, source)
    rho_H = (fluid.rho * H)[1:-1]
    expected = (rho_H[:, :-2] - rho_H[:, 1:-1]) / mesh.dX
    np.testing.assert_allclose(source[:, 1:-1], expected, rtol=1e-11, atol=1e-12)
    # The conductances above are those of the faces themselves.
    x = x_flows(fluid[1:-1], status[1:-1], mesh, Scheme())[0].value
    np.testing.assert_allclose(x / mesh.dX, rho_H[:, :-1] / mesh.dX - along * np.diff(P[1:-1]), rtol=1e-12)
    y = y_flows(fluid, status, mesh, Scheme()).value
    np.testing.assert_allclose(y / mesh.dY, -across * np.diff(P, axis=0), rtol=1e-12, atol=1e-15)


def projected_gauss_seidel(P, movable, source, along, across):
    """The complementarity problem by brute force: point by point, until nothing moves."""
    P = P.copy()
    for _ in range(5000):
        before = P.copy()
        for j, i in np.argwhere(movable):
            c = along[j, i - 1], along[j, i], across[j, i], across[j + 1, i]
            neighbours = P[j + 1, i - 1], P[j + 1, i + 1], P[j, i], P[j + 2, i]
            P[j + 1, i] = max(0.0, (source[j, i] + np.dot(c, neighbours)) / sum(c))
        if np.abs(P - before).max() < 1e-15:
            return P
    raise AssertionError("projected Gauss-Seidel did not converge")


def sweep_to_rest(P, lubricated, movable, source, along, across, passes):
    """Zebra sweeps until neither status nor pressure moves."""
    for _ in range(3000):
        before = P.copy()
        changes = sum(
            relax_cavitation(first, P, lubricated, movable, source, along, across, passes)
            for first in (0, 1)
        )
        if changes == 0 and np.abs(P - before).max() < 1e-14:
            return
    raise AssertionError("the sweeps did not come to rest")


@pytest.mark.parametrize("passes", [1, 2, 5])
@pytest.mark.parametrize("full_at_first", [True, False], ids=["from a film", "from a cavity"])
@pytest.mark.parametrize("ends", [0.0, 0.7], ids=["ends at zero", "ends at a pressure"])
def test_relax_cavitation_solves_the_complementarity_problem(ends, full_at_first, passes, rng):
    """P >= 0, inflow <= 0, one of them zero at movable nodes; the solution is unique."""
    lines, nx = 6, 11
    along, across = conductances(rng, lines, nx, closed=0.1)
    source = rng.standard_normal((lines, nx))
    movable = rng.random((lines, nx)) < 0.85
    movable[:, [0, -1]] = False
    P = rng.uniform(0.0, 0.5, (lines + 2, nx))
    P[:, [0, -1]] = ends
    given = P.copy()
    expected = projected_gauss_seidel(P, movable, source, along, across)
    lubricated = movable & full_at_first
    sweep_to_rest(P, lubricated, movable, source, along, across, passes)

    np.testing.assert_allclose(P, expected, rtol=1e-10, atol=1e-12)
    inflow = source[:, 1:-1] + poiseuille_inflow(P, along, across)
    film, cavity = (lubricated & movable)[:, 1:-1], (~lubricated & movable)[:, 1:-1]
    assert film.any() and cavity.any()
    assert np.abs(inflow[film]).max() < 1e-12
    assert (P[1:-1, 1:-1][film] >= 0.0).all()
    assert (P[1:-1, 1:-1][cavity] == 0.0).all() and (inflow[cavity] <= 1e-14).all()
    fixed = np.ones_like(P, bool)
    fixed[1:-1] = ~movable
    assert (P[fixed] == given[fixed]).all()


def test_relax_cavitation_touches_every_other_line_and_counts_changes(rng):
    """From line 1 only lines 1, 3, ... move; a dry cavity with a sink everywhere changes nothing."""
    lines, nx = 5, 9
    along, across = conductances(rng, lines, nx)
    movable = np.ones((lines, nx), bool)
    movable[:, [0, -1]] = False
    P, lubricated = np.zeros((lines + 2, nx)), np.zeros((lines, nx), bool)
    args = movable, -np.ones((lines, nx)), along, across, 1
    assert relax_cavitation(0, P, lubricated, *args) == 0
    assert not P.any() and not lubricated.any()

    source = np.ones((lines, nx))
    changes = relax_cavitation(1, P, lubricated, movable, source, along, across, 1)
    assert changes == 2 * (nx - 2)
    assert lubricated[1::2, 1:-1].all() and not lubricated[::2].any()
    relax_cavitation(1, P, lubricated, movable, source, along, across, 1)
    assert (P[2:-1:2, 1:-1] > 0.0).all() and not P[1::2].any()
