"""The compiled loops over banded systems against numpy twins that say the same slowly."""

import numpy as np
import pytest
from dense import ALONG_X, BOTH_WAYS, dense_JQ, line_stencils

from mgehl.discretization.band_kernels import REACH, SIDE_BY_SIDE, banded, build_bands, span_of
from mgehl.discretization.bands import LINES_BESIDE, REACH_OF_STENCIL, influence_of_columns
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.mesh import Mesh
from mgehl.model.deformation import HalfSpace

every_stencil = pytest.mark.parametrize("offsets", [ALONG_X, BOTH_WAYS], ids=["along x", "both ways"])


@pytest.fixture
def rng():
    return np.random.default_rng(11)


@pytest.mark.parametrize("distributed", [0.0, 0.5, 1.0], ids=["identity", "partly", "all"])
@pytest.mark.parametrize("k_e, share", [(1.0, 0.25), (0.6, 0.25), (0.6, 0.5)])
@every_stencil
def test_build_bands_is_the_band_of_J_Q(offsets, distributed, k_e, share, rng):
    """Entry (i, m) of each line is that of (A + B K) Q with dense K and Q, up to REACH nodes away."""
    mesh = Mesh(15, 11, (-1.9, 1.3), (-1.5, 1.5), k_e)
    lines, nx = 3, mesh.nx
    K = influence_coefficients(mesh, HalfSpace(0.2))
    A, B = line_stencils(rng, offsets, lines, nx)
    distributive = rng.random((lines, nx)) < distributed
    # A line's ends are given; their column would reach outside the domain.
    distributive[:, [0, -1]] = False
    bands, kappa = np.full((lines, nx, 2 * REACH + 1), np.nan), influence_of_columns(K, share)
    stencils = np.array(offsets), A, B, distributive, kappa, share
    build_bands(*stencils, bands, (0, 1), (0, nx))
    assert np.isnan(bands[1:]).all()
    build_bands(*stencils, bands, (1, lines), (0, nx))
    JQ = dense_JQ(offsets, A, B, K, distributive, share, REACH)
    expected = bands.copy()  # beyond a line's ends anything
    for j, i, k in np.ndindex(*bands.shape):
        if 0 <= i + k - REACH < nx:
            expected[j, i, k] = JQ[j, i, j, i + k - REACH]
    np.testing.assert_allclose(bands, expected, rtol=1e-12, atol=1e-13)


@every_stencil
def test_build_bands_of_some_nodes(offsets, rng):
    """What the nodes of a span couple among each other; the others' entries are left alone."""
    lines, nx, (first, end) = 3, 15, (4, 13)
    K = influence_coefficients(Mesh(nx, 11, (-1.9, 1.3), (-1.5, 1.5)), HalfSpace(0.2))
    A, B = line_stencils(rng, offsets, lines, nx)
    distributive = rng.random((lines, nx)) < 0.5
    distributive[:, :first], distributive[:, end:] = False, False
    stencils = np.array(offsets), A, B, distributive, influence_of_columns(K, 0.25), 0.25
    whole, some = np.full((2, lines, nx, 2 * REACH + 1), np.nan)
    build_bands(*stencils, whole, (0, lines), (0, nx))
    build_bands(*stencils, some, (0, lines), (first, end))
    assert np.isnan(some[:, :first]).all() and np.isnan(some[:, end:]).all()
    for i, k in np.ndindex(end - first, 2 * REACH + 1):
        if first <= first + i + k - REACH < end:
            np.testing.assert_array_equal(some[:, first + i, k], whole[:, first + i, k])


@pytest.mark.parametrize(
    "lines, expected",
    [((0, 1), (1, 6)), ((1, 2), (3, 8)), ((0, 2), (1, 8)), ((2, 3), (0, 0)), ((2, 4), (0, 8))],
    ids=["begins late", "to the end", "both", "nothing moves", "from the beginning"],
)
def test_span_from_before_the_first_to_behind_the_last_node_that_moves(lines, expected):
    given = np.array([list(line) for line in ("xx.x.xxx", "xxxx....", "xxxxxxxx", "......x.")]) == "x"
    assert span_of(given, lines) == expected


def test_the_stencils_of_these_tests_reach_as_far_as_the_bands_know():
    assert {abs(line) for line, _ in BOTH_WAYS} == set(range(LINES_BESIDE + 1))


@pytest.mark.parametrize("lines", [1, SIDE_BY_SIDE, 3 * SIDE_BY_SIDE + 1])
@pytest.mark.parametrize("nx", [2, 5, 6, 23])
@pytest.mark.parametrize("reach", [REACH, REACH_OF_STENCIL])
def test_banded_solve_against_dense(lines, nx, reach, rng):
    """Lines shorter and longer than the band; what a band holds outside the line is ignored."""
    factor, solve = banded(reach)
    bands = rng.standard_normal((lines, nx, 2 * reach + 1))
    bands[:, :, reach] += 12.0
    dense = np.zeros((lines, nx, nx))
    for j, i, k in np.ndindex(*bands.shape):
        if 0 <= i + k - reach < nx:
            dense[j, i, i + k - reach] = bands[j, i, k]
        else:
            bands[j, i, k] = np.nan
    r, w = rng.standard_normal((lines, nx)), np.full((lines, nx), np.nan)
    factor(bands, (0, nx))
    solve(bands, np.tile([0, nx], (lines, 1)), r, w)
    expected = [np.linalg.solve(matrix, line) for matrix, line in zip(dense, r, strict=True)]
    np.testing.assert_allclose(w, expected, rtol=1e-12, atol=1e-14)


def test_banded_solve_of_the_nodes_of_spans(rng):
    """Lines side by side have spans of their own; beyond them it is zero, whatever the bands hold."""
    factor, solve = banded(REACH)
    spans = np.array([[0, 23], [3, 20], [3, 20], [3, 19], [0, 0], [7, 8]])
    lines, nx = len(spans), 23
    bands = rng.standard_normal((lines, nx, 2 * REACH + 1))
    bands[:, :, REACH] += 12.0
    whole, r, w = bands.copy(), rng.standard_normal((lines, nx)), np.full((lines, nx), np.nan)
    for line, (first, end) in enumerate(spans):
        bands[line, :first], bands[line, end:] = np.nan, np.nan
        factor(bands[line : line + 1], (first, end))
    solve(bands, spans, r, w)
    for line, (first, end) in enumerate(spans):
        dense = np.zeros((nx, nx))
        for i, k in np.ndindex(nx, 2 * REACH + 1):
            if 0 <= i + k - REACH < nx:
                dense[i, i + k - REACH] = whole[line, i, k]
        inside = slice(first, end)
        expected = np.zeros(nx)
        expected[inside] = np.linalg.solve(dense[inside, inside], r[line, inside])
        np.testing.assert_allclose(w[line], expected, rtol=1e-12, atol=1e-14)
