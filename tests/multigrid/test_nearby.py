import numpy as np
import pytest

from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.kernels import distribute
from mgehl.discretization.mesh import HALO
from mgehl.multigrid.nearby import NearbySolve

SHARE = 0.25
REACH = 1
"""Nodes on each side whose deflection is in the matrix."""


@pytest.fixture
def influence(jacobian):
    mesh, kernel = jacobian.grid.mesh, jacobian.contact.kernel
    return influence_coefficients(mesh, kernel, 0, mesh.ny + 1)[:, : mesh.nx + 1]


@pytest.fixture
def masks(jacobian, masks):
    return [jacobian.grid.halo(mask) for mask in masks]


@pytest.fixture(params=["everywhere", "in the middle"])
def zone(request, jacobian):
    grid = jacobian.grid
    return (grid.X**2 + grid.Y**2 < 1.0) | (request.param == "everywhere")


@pytest.fixture
def nearby(jacobian, influence, zone):
    solve = NearbySolve(jacobian, influence, SHARE, zone)
    yield solve
    solve.free()


def columns_of(jacobian, influence, masks):
    """T column by column: what the Jacobian makes of each column of Q and of its near deflection."""
    grid = jacobian.grid
    lines, nx = grid.shape
    distributive, free = masks
    for j, i in np.ndindex(lines, nx):
        w, column = np.zeros(grid.ghosted_shape), np.zeros(grid.shape)
        w[j + HALO, i] = 1.0
        distribute(w, distributive, SHARE, 1.0, column, True)
        column[(free[HALO:-HALO] == 0.0) & (column != 1.0)] = 0.0
        dH = np.zeros(grid.shape)
        if free[j + HALO, i]:
            spread = distributive[j + HALO, i]
            near = [(b, a) for b, a in np.ndindex(lines, nx) if max(abs(b - j), abs(a - i)) <= REACH]
            for b, a in near:
                around = [(b + 1, a), (b - 1, a), (b, a + 1), (b, a - 1)]
                handed = sum(influence[abs(bb - j), abs(aa - i)] for bb, aa in around)
                dH[b, a] = influence[abs(b - j), abs(a - i)] - SHARE * spread * handed
        yield jacobian.product(column, dH, 0.0).ravel().copy()


def test_matrix_is_the_near_part_of_j_q(jacobian, influence, masks, nearby):
    found = nearby.matrix(*masks)[:, :]
    expected = np.column_stack(list(columns_of(jacobian, influence, masks)))
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-12 * np.abs(expected).max())


def test_it_solves_with_that_matrix_in_its_zone(jacobian, masks, zone, nearby):
    dense = nearby.matrix(*masks)[:, :]
    w, found = np.random.default_rng(4).standard_normal(jacobian.grid.shape), np.ones(jacobian.grid.shape)
    w[~zone] = 0.0
    for _ in range(2):  # again and again
        nearby.factor(*masks)
        nearby.solve((dense @ w.ravel()).reshape(w.shape), found)
        np.testing.assert_allclose(found, w, rtol=0.0, atol=1e-9)


def test_without_a_package_each_rank_solves_the_whole(monkeypatch, jacobian, masks, zone, nearby):
    monkeypatch.setattr("mgehl.multigrid.nearby.PACKAGES", ())
    test_it_solves_with_that_matrix_in_its_zone(jacobian, masks, zone, nearby)
