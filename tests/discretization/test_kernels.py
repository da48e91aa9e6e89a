"""The compiled loops against numpy twins that say the same slowly."""

import numpy as np
import pytest
from dense import ALONG_X, BOTH_WAYS, dense_Q, dense_stencil, line_stencils

from mgehl.discretization.axes import HALO, Axis, own
from mgehl.discretization.kernels import (
    add_of_faces,
    add_poiseuille,
    add_poiseuille_slopes,
    apply_jacobian,
    apply_stencil,
    deflect_nearby,
    distribute,
    flow_sources,
    lifted_by_less,
    relax_cavitation,
)

every_stencil = pytest.mark.parametrize("offsets", [ALONG_X, BOTH_WAYS], ids=["along x", "both ways"])


@pytest.fixture
def rng():
    return np.random.default_rng(11)


@every_stencil
def test_apply_jacobian(offsets, rng):
    """out = A dP + B (dH + dH0) against dense matrices."""
    lines, nx = 4, 7
    A, B = line_stencils(rng, offsets, lines, nx)
    dP, dH = rng.standard_normal((2, lines + 2 * HALO, nx))
    out = np.full((lines, nx), np.nan)
    apply_jacobian(np.array(offsets), A, B, dP, dH, 0.3, out)
    expected = dense_stencil(offsets, A) @ dP.ravel() + dense_stencil(offsets, B) @ (dH + 0.3).ravel()
    np.testing.assert_allclose(out.ravel(), expected, rtol=1e-13, atol=1e-13)


@every_stencil
def test_apply_stencil(offsets, rng):
    lines, nx = 4, 7
    A, _ = line_stencils(rng, offsets, lines, nx)
    dP, out = rng.standard_normal((lines + 2 * HALO, nx)), np.full((lines, nx), np.nan)
    apply_stencil(np.array(offsets), A, dP, out)
    expected = dense_stencil(offsets, A) @ dP.ravel()
    np.testing.assert_allclose(out.ravel(), expected, rtol=1e-13, atol=1e-13)


def test_coefficients_of_nodes_beyond_a_line_s_ends_are_not_used(rng):
    """Whatever they are: no memory beside the line is read."""
    lines, nx, offsets = 3, 6, np.array(BOTH_WAYS)
    A, B = rng.standard_normal((2, len(offsets), lines, nx))
    node = np.arange(nx)
    dP, dH = rng.standard_normal((2, lines + 2 * HALO, nx))
    found, cut = np.empty((lines, nx)), np.empty((lines, nx))
    apply_jacobian(offsets, A, B, dP, dH, 0.3, found)
    for k, (_, ahead) in enumerate(offsets):
        beyond = (node + ahead < 0) | (node + ahead >= nx)
        A[k][:, beyond] = B[k][:, beyond] = np.nan
    apply_jacobian(offsets, A, B, dP, dH, 0.3, cut)
    np.testing.assert_array_equal(found, cut)


@pytest.mark.parametrize("share", [0.25, 0.5])
def test_distribute(share, rng):
    """omega Q w against the dense Q of all ghosted lines."""
    lines, nx, omega = 4, 7, 0.8
    w, distributive = (rng.standard_normal((lines + 2 * HALO, nx)) for _ in range(2))
    distributive = distributive > 0.0
    out = np.full((lines, nx), np.nan)
    distribute(w, distributive, share, omega, out)
    expected = (
        omega
        * (dense_Q(distributive, share) @ w.ravel()).reshape(lines + 4 * HALO, nx)[2 * HALO : -2 * HALO]
    )
    np.testing.assert_allclose(out, expected, rtol=1e-14, atol=1e-15)


@pytest.mark.parametrize("nx", [2, 3, 8])
def test_deflect_nearby(nx, rng):
    """Of pressures on the lines and on those beside them; beyond the ends of a line there is none."""
    lines, K = 3, rng.random((2, 2))
    p, out = rng.standard_normal((lines + 2 * HALO, nx)), np.full((lines, nx), np.nan)
    deflect_nearby(K, p, out)
    expected, padded = np.zeros((lines, nx)), np.pad(p, ((0, 0), (1, 1)))
    for line, node in np.ndindex(3, 3):
        beside = padded[HALO - 1 + line :][:lines, node : node + nx]
        expected += K[abs(line - 1), abs(node - 1)] * beside
    np.testing.assert_allclose(out, expected, rtol=1e-13, atol=1e-14)


@pytest.fixture(params=[1, 0], ids=["along x", "along y"])
def axis(request):
    return Axis(request.param, 0.5, 0.25, 1.0)


def gradients(P, axis, distance):
    return (axis.at(P, 1) - axis.at(P, 0)) / distance


def test_add_poiseuille(axis, rng):
    P = rng.standard_normal((4 + 2 * HALO, 7))
    conductance, before = rng.standard_normal((2, *axis.at(P).shape))
    flow = before.copy()
    add_poiseuille(axis.sides, P, conductance, flow)
    np.testing.assert_allclose(flow, before - conductance * (axis.at(P, 1) - axis.at(P, 0)), rtol=1e-13)


@pytest.mark.parametrize("alone", [False, True], ids=["by face", "one line for all"])
def test_add_poiseuille_slopes(axis, alone, rng):
    P, eps_by = rng.standard_normal((2, 4 + 2 * HALO, 7))
    lines, faces = axis.at(P).shape
    distance = rng.uniform(0.1, 1.0, faces)
    by_eps = rng.standard_normal((2, 1 if alone else lines, faces))
    before = rng.standard_normal((2, lines, faces))
    found = before.copy()
    add_poiseuille_slopes(axis.sides, P, 1.0 / distance, *by_eps, eps_by, *found)
    for side in (0, 1):
        change = gradients(P, axis, distance) * by_eps[side] * axis.at(eps_by, side)
        np.testing.assert_allclose(found[side], before[side] - change, rtol=1e-13, atol=1e-14)


def poiseuille_inflow(P, along, across):
    """L P of ghosted P in plain numpy, (lines, nx - 2)."""
    x = along * np.diff(own(P), axis=1)
    y = across * np.diff(P[HALO - 1 : len(P) - HALO + 1], axis=0)
    return np.diff(x, axis=1) + np.diff(y, axis=0)[:, 1:-1]


def conductances(rng, lines, nx, closed=0.0):
    along, across = rng.uniform(0.2, 2.0, (lines, nx - 1)), rng.uniform(0.2, 2.0, (lines + 1, nx))
    along[rng.random(along.shape) < closed] = 0.0
    return along, across


@pytest.mark.parametrize("number", [0, 1], ids=["along Y", "along X"])
@pytest.mark.parametrize("which", [0, 1], ids=["entering", "leaving"])
def test_add_of_faces(number, which, rng):
    """A node's faces are those before and behind it; ends of lines along X have none."""
    flow = rng.standard_normal((4, 6) if number else (5, 7))
    inflow = rng.standard_normal((4, 7))
    expected = inflow.copy()
    if number:
        expected[:, 1:-1] += flow[:, which : which + 5] / 0.3
    else:
        expected += flow[which : which + 4] / 0.3
    add_of_faces(number, which, flow, 0.3, inflow)
    np.testing.assert_allclose(inflow, expected, rtol=1e-14)


def test_flow_sources(rng):
    """Inflow less L P at inner nodes; line ends keep what they had."""
    lines, nx = 4, 7
    P, inflow = rng.standard_normal((lines + 2 * HALO, nx)), rng.standard_normal((lines, nx))
    along, across = conductances(rng, lines, nx)
    source = np.full((lines, nx), 5.0)
    flow_sources(inflow, P, along, across, source)
    expected = inflow[:, 1:-1] - poiseuille_inflow(P, along, across)
    np.testing.assert_allclose(source[:, 1:-1], expected, rtol=1e-13, atol=1e-13)
    assert (source[:, [0, -1]] == 5.0).all()


def projected_gauss_seidel(P, movable, source, along, across):
    """The complementarity problem by brute force: point by point, until nothing moves."""
    P = P.copy()
    for _ in range(5000):
        before = P.copy()
        for j, i in np.argwhere(movable):
            c, g = (along[j, i - 1], along[j, i], across[j, i], across[j + 1, i]), j + HALO
            neighbours = P[g, i - 1], P[g, i + 1], P[g - 1, i], P[g + 1, i]
            P[g, i] = max(0.0, (source[j, i] + np.dot(c, neighbours)) / sum(c))
        if np.abs(P - before).max() < 1e-15:
            return P
    raise AssertionError("projected Gauss-Seidel did not converge")


def sweep_to_rest(w, film, movable, *faces):
    """Zebra sweeps until neither status nor pressure moves."""
    for _ in range(5000):
        before = w.copy()
        changes = sum(relax_cavitation(first, w, film, movable, *faces) for first in (0, 1))
        if changes == 0 and np.abs(w - before).max() < 1e-14:
            return
    raise AssertionError("the sweeps did not come to rest")


def test_lifted_by_less(rng):
    """Without a division: a node that is shut in answers, too."""
    source, H, conductance = rng.standard_normal((3, 4, 7))
    conductance[0], source[0, :3] = 0.0, 0.0
    found = np.empty((4, 7), dtype=bool)
    lifted_by_less(0.5, 0.3, source, H, conductance, found)
    np.testing.assert_array_equal(found, 0.5 * np.abs(source) <= 0.3 * H * conductance)
    assert found[0, :3].all() and not found[0, 3:].any() and found.any()


def some_movable(rng, lines, nx):
    movable = rng.random((lines, nx)) < 0.85
    movable[:, [0, -1]] = False
    return movable


every_start = pytest.mark.parametrize("full_at_first", [True, False], ids=["from a film", "from a cavity"])
every_pass = pytest.mark.parametrize("passes", [1, 2, 5])


@every_pass
@every_start
@pytest.mark.parametrize("ends", [0.0, 0.7], ids=["ends at zero", "ends at a pressure"])
def test_relax_cavitation_solves_the_complementarity_problem(ends, full_at_first, passes, rng):
    """Cavities that count as full: P >= 0, inflow <= 0, one of them zero; the solution is unique."""
    lines, nx = 6, 11
    along, across = conductances(rng, lines, nx, closed=0.1)
    source, movable = rng.standard_normal((lines, nx)), some_movable(rng, lines, nx)
    w = rng.uniform(0.0, 0.5, (lines + 2 * HALO, nx))
    w[:, [0, -1]] = ends
    given = w.copy()
    expected = projected_gauss_seidel(w, movable, source, along, across)
    film = ~movable | full_at_first
    if not full_at_first:
        own(w)[movable] = 0.0
    nothing = np.zeros((lines, nx - 1)), np.zeros((lines + 1, nx))
    sweep_to_rest(w, film, movable, source, (along, across), nothing, passes)

    P = np.maximum(w, 0.0)
    np.testing.assert_allclose(P, expected, rtol=1e-10, atol=1e-12)
    inflow = source[:, 1:-1] + poiseuille_inflow(P, along, across)
    film, cavity = (film & movable)[:, 1:-1], (~film & movable)[:, 1:-1]
    assert film.any() and cavity.any()
    assert np.abs(inflow[film]).max() < 1e-12
    assert (own(w)[:, 1:-1][film] >= 0.0).all()
    assert (own(w)[:, 1:-1][cavity] <= 0.0).all() and (inflow[cavity] <= 1e-14).all()
    fixed = np.ones_like(w, bool)
    own(fixed)[:] = ~movable
    assert (w[fixed] == given[fixed]).all()


def net_carried(filling, along_x, along_y):
    """What is carried into nodes and not out of them, (lines, nx - 2), by ghosted fillings."""
    through_x = along_x * own(filling)[:, :-1]
    through_y = along_y * filling[HALO - 1 : len(filling) - HALO]
    return -np.diff(through_x, axis=1) - np.diff(through_y, axis=0)[:, 1:-1]


@every_pass
@every_start
@pytest.mark.parametrize("oblique", [False, True], ids=["along X", "along X and Y"])
def test_relax_cavitation_balances_film_and_what_cavities_hold(oblique, full_at_first, passes, rng):
    """Every movable node's inflow is nothing: by P >= 0 of a full node, or by a filling from 0 to 1."""
    lines, nx = 6, 15
    faces = along, across = conductances(rng, lines, nx)
    carried = along_x, along_y = rng.uniform(2.0, 4.0, (lines, nx - 1)), np.zeros((lines + 1, nx))
    if oblique:
        along_y += rng.uniform(1.0, 2.0, along_y.shape)
    source, movable = np.zeros((lines, nx)), some_movable(rng, lines, nx)
    source[:, 1:-1] = net_carried(np.ones((lines + 2 * HALO, nx)), *carried)
    film = ~movable | full_at_first
    w = np.zeros((lines + 2 * HALO, nx))
    own(w)[~movable] = rng.uniform(0.0, 0.5, np.count_nonzero(~movable))
    own(w)[:, nx // 2][~movable[:, nx // 2]] = -0.6  # cavities that are given
    film[:, nx // 2] &= movable[:, nx // 2]
    given = w.copy()
    sweep_to_rest(w, film, movable, source, faces, carried, passes)

    P, empty = np.maximum(w, 0.0), np.maximum(-w, 0.0)
    inflow = source[:, 1:-1] + poiseuille_inflow(P, along, across) + net_carried(-empty, *carried)
    inner = movable[:, 1:-1]
    assert (film & movable).any() and (own(empty)[movable] > 0.01).any() and (own(P)[movable] > 0.01).any()
    assert np.abs(inflow[inner]).max() < 1e-12 and empty.max() < 1.0
    assert (own(w)[film] >= 0.0).all() and (own(w)[~film] <= 0.0).all()
    np.testing.assert_array_equal(own(w)[~movable], own(given)[~movable])


def test_relax_cavitation_touches_every_other_line_and_counts_changes(rng):
    """From line 1 only lines 1, 3, ... move; a dry cavity with a sink everywhere changes nothing."""
    lines, nx = 5, 9
    faces = conductances(rng, lines, nx)
    nothing = np.zeros((lines, nx - 1)), np.zeros((lines + 1, nx))
    movable = np.ones((lines, nx), bool)
    movable[:, [0, -1]] = False
    w, film = np.zeros((lines + 2 * HALO, nx)), ~movable
    assert relax_cavitation(0, w, film, movable, -np.ones((lines, nx)), faces, nothing, 1) == 0
    assert (w <= 0.0).all() and not film[:, 1:-1].any()

    w[:], source = 0.0, np.ones((lines, nx))
    assert relax_cavitation(1, w, film, movable, source, faces, nothing, 1) == 2 * (nx - 2)
    assert film[1::2, 1:-1].all() and not film[::2, 1:-1].any()
    relax_cavitation(1, w, film, movable, source, faces, nothing, 1)
    assert (own(w)[1::2, 1:-1] > 0.0).all() and not own(w)[::2].any()
