import numpy as np
import pytest
from dense import ALONG_X, BOTH_WAYS, dense_JQ, dense_stencil, line_stencils

from mgehl.discretization.axes import HALO
from mgehl.discretization.band_kernels import REACH
from mgehl.discretization.bands import (
    AT_A_TIME,
    REACH_OF_STENCIL,
    STENCILS_AT_A_TIME,
    STIFF,
    LineBands,
    distributive_nodes,
    influence_of_columns,
)
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.residual import Linearisation
from mgehl.discretization.rows import FLOW, GAP, PRESSURE
from mgehl.model.deformation import HalfSpace

MESH = Mesh(15, 11, (-1.9, 1.3), (-1.5, 1.5), k_e=0.6)
K = influence_coefficients(MESH, HalfSpace(0.2))
every_stencil = pytest.mark.parametrize("offsets", [ALONG_X, BOTH_WAYS], ids=["along x", "both ways"])
every_share = pytest.mark.parametrize("share", [0.25, 0.5])


@pytest.mark.parametrize(
    "row, mobility, distributed",
    [
        (FLOW, 0.99, True),
        (FLOW, 1.01, False),
        (GAP, 0.0, True),
        (GAP, -1.0, True),
        (GAP, 50.0, True),
        (PRESSURE, 0.0, False),
        (PRESSURE, 50.0, False),
    ],
)
def test_distributive_in_contact_and_where_poiseuille_flow_is_weak(row, mobility, distributed):
    """`mobility` in units of the threshold eps = STIFF K00 dX; given pressures never distribute."""
    dX, K00 = 0.25, 0.4
    rows, eps = np.full((5, 7), FLOW), np.full((5, 7), 10.0)
    rows[2, 3], eps[2, 3] = row, mobility * STIFF * K00 * dX
    expected = np.zeros((5, 7), bool)
    expected[2, 3] = distributed
    assert (distributive_nodes(eps, rows, dX, K00) == expected).all()


def given_ends(lines, nx):
    """Two masks of given nodes: none; and from three to six at each end, some between, whole lines."""
    nodes, line = np.arange(nx), np.arange(lines)[:, None]
    ends = (nodes < 3 + line % 4) | (nodes >= nx - 3 - line % 3) | (nodes == 8)
    return np.zeros((lines, nx), dtype=bool), ends | (line >= STENCILS_AT_A_TIME)


@every_stencil
def test_line_bands_solve_the_lines_of_a_stencil(offsets):
    """A rigid gap: factor_stencil against numpy.linalg.solve, twice with the same bands."""
    rng = np.random.default_rng(6)
    lines, nx = STENCILS_AT_A_TIME + 2, MESH.nx
    bands = LineBands(lines, nx, REACH_OF_STENCIL)
    for A, given in zip(line_stencils(rng, offsets, lines, nx), given_ends(lines, nx), strict=True):
        A[0] += 8.0
        A[:, given] = 0.0
        A[0, given] = -7.0
        r, w = np.where(given, 0.0, rng.standard_normal((lines, nx))), np.empty((lines, nx))
        bands.factor_stencil(Linearisation(np.array(offsets), A, None, None), given)
        bands.solve(r, w)
        J = dense_stencil(offsets, A).reshape(lines, nx, lines + 2 * HALO, nx)
        for j in range(lines):
            line = J[j, :, j + HALO]
            np.testing.assert_allclose(w[j], np.linalg.solve(line, r[j]), rtol=1e-11, atol=1e-13)


@every_share
@every_stencil
def test_line_bands_solve_the_band_of_J_Q(offsets, share):
    """LineBands against numpy.linalg.solve on the dense lines of (A + B K) Q cut to the band."""
    rng = np.random.default_rng(5)
    lines, nx = AT_A_TIME + 1, MESH.nx
    A, B = line_stencils(rng, offsets, lines, nx)
    distributive = rng.random((lines, nx)) < 0.5
    distributive[:, [0, -1]] = False
    JQ = dense_JQ(offsets, A, B, K, distributive, share, REACH)
    r, w = rng.standard_normal((lines, nx)), np.empty((lines, nx))
    bands, kappa = LineBands(lines, nx), influence_of_columns(K, share)
    # A second factorisation must not see the first.
    for stencils in ((B, A), (A, B)):
        linear, given = Linearisation(np.array(offsets), *stencils, None), np.zeros((lines, nx), bool)
        diagonal = bands.factor(linear, distributive, given, kappa, share)
    np.testing.assert_allclose(diagonal, np.einsum("jiji->ji", JQ), rtol=1e-13)
    bands.solve(r, w)
    offset = np.subtract.outer(np.arange(nx), np.arange(nx))
    for j in range(lines):
        line = np.where(np.abs(offset) <= REACH, JQ[j, :, j], 0.0)
        np.testing.assert_allclose(w[j], np.linalg.solve(line, r[j]), rtol=1e-11, atol=1e-13)


@pytest.mark.parametrize("before", [0, 1, AT_A_TIME - 1, AT_A_TIME])
def test_lines_have_their_spans_with_the_same_lines_on_any_number_of_ranks(before):
    """Some lines of a plane alone are solved as they are among all."""
    rng = np.random.default_rng(7)
    lines, nx = 2 * AT_A_TIME + 3, MESH.nx
    A, B = line_stencils(rng, ALONG_X, lines, nx)
    given = np.arange(nx) < rng.integers(1, 7, lines)[:, None]
    A[1:, given], B[:, given] = 0.0, 0.0
    distributive = (rng.random((lines, nx)) < 0.5) & ~given
    r, kappa = rng.standard_normal((lines, nx)), influence_of_columns(K, 0.25)
    found = []
    for first in (0, before):
        bands, w = LineBands(lines - first, nx, before=first), np.empty((lines - first, nx))
        stencils = (np.ascontiguousarray(each[:, first:]) for each in (A, B))
        nodes = distributive[first:], given[first:]
        diagonal = bands.factor(Linearisation(np.array(ALONG_X), *stencils, None), *nodes, kappa, 0.25)
        bands.solve(r[first:], w)
        found.append((diagonal[-AT_A_TIME:], w[-AT_A_TIME:]))
    np.testing.assert_array_equal(*(diagonal for diagonal, _ in found))
    np.testing.assert_array_equal(*(w for _, w in found))
