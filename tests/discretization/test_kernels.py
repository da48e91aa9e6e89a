"""The compiled loops against numpy twins that say the same slowly."""

import numpy as np
import pytest
from dense import ALONG_X, BOTH_WAYS, dense_stencil, line_stencils

from mgehl.discretization.axes import HALO, Axis, own
from mgehl.discretization.kernels import apply_jacobian, relax_cavitation

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


@pytest.fixture(params=[1, 0], ids=["along x", "along y"])
def axis(request):
    return Axis(request.param, 0.5, 0.25, 1.0)


def poiseuille_inflow(P, along, across):
    """L P of ghosted P in plain numpy, (lines, nx - 2)."""
    x = along * np.diff(own(P), axis=1)
    y = across * np.diff(P[HALO - 1 : len(P) - HALO + 1], axis=0)
    return np.diff(x, axis=1) + np.diff(y, axis=0)[:, 1:-1]


def conductances(rng, lines, nx, closed=0.0):
    along, across = rng.uniform(0.2, 2.0, (lines, nx - 1)), rng.uniform(0.2, 2.0, (lines + 1, nx))
    along[rng.random(along.shape) < closed] = 0.0
    return along, across


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
