"""The compiled loops over y-lines against those over x-lines and against dense matrices."""

import numpy as np
import pytest
from dense import BOTH_WAYS

from mgehl.discretization.band_kernels import REACH, build_bands
from mgehl.discretization.bands import influence_of_columns
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.y_band_kernels import (
    build_y_bands,
    factor_y_bands,
    solve_y_bands,
    spans_of_nodes,
)
from mgehl.model.deformation import HalfSpace

NY, NX, WIDTH = 13, 7, 2 * REACH + 1
SPANS = np.array([[0, 0], [2, 5], [0, 7], [1, 7], [3, 4], [0, 0], *([[0, 7]] * 6), [6, 7]])
"""Of x-lines that take part from end to end, partly and not at all."""


@pytest.fixture
def rng():
    return np.random.default_rng(12)


def takes_part(spans):
    """(lines, NX)"""
    nodes = np.arange(NX)
    return (spans[:, :1] <= nodes) & (nodes < spans[:, 1:])


def test_spans_of_nodes_that_are_not_given():
    given = np.array([list(line) for line in ("xx.x.xxx", "........", "xxxxxxxx", "......x.")]) == "x"
    np.testing.assert_array_equal(spans_of_nodes(given), [[2, 5], [0, 8], [8, 0], [0, 8]])


@pytest.mark.parametrize("some", [(0, NY), (4, 9)], ids=["all lines", "those of a rank in the middle"])
def test_y_bands_are_the_bands_of_the_turned_plane(some, rng):
    """Each stencil is turned with its offsets; lines of other ranks are known by what is distributive."""
    first, end = some
    K = influence_coefficients(Mesh(NX, NY, (-1.9, 1.3), (-1.5, 1.5)), HalfSpace(0.2))
    kappa, offsets = influence_of_columns(K, 0.25), np.array(BOTH_WAYS)
    A, B = rng.standard_normal((2, len(offsets), NY, NX))
    distributive = rng.random((NY, NX)) < 0.5
    turned = np.empty((NX, NY, WIDTH))
    stencils = (np.ascontiguousarray(each.transpose(0, 2, 1)) for each in (A, B))
    backward = np.ascontiguousarray(offsets[:, ::-1])
    build_bands(backward, *stencils, distributive.T.copy(), kappa, 0.25, turned, (0, NX), (0, NY))
    bands, around = (
        np.full((end - first, WIDTH, NX), np.nan),
        np.pad(distributive, ((REACH, REACH), (0, 0))),
    )
    mine = (np.ascontiguousarray(each[:, first:end]) for each in (A, B))
    spans = SPANS[first:end]
    build_y_bands(offsets, *mine, around[first : end + 2 * REACH], kappa, 0.25, spans, bands)
    inside = takes_part(spans)
    assert np.isnan(bands.transpose(0, 2, 1)[~inside]).all()
    for j, k in np.ndindex(end - first, WIDTH):
        if 0 <= first + j + k - REACH < NY:
            found, expected = bands[j, k], turned[:, first + j, k]
            np.testing.assert_allclose(found[inside[j]], expected[inside[j]], rtol=1e-13, atol=1e-14)


@pytest.mark.parametrize("columns", [(0, NX), (2, 6)], ids=["all", "those of one rank"])
def test_solution_of_y_lines_against_dense(columns, rng):
    """Beyond spans and ends bands hold anything; there w becomes zero, and beyond the columns it stays."""
    spans = np.clip(SPANS, *columns)
    inside = takes_part(spans)
    bands = rng.standard_normal((NY, WIDTH, NX))
    bands[:, REACH] += 12.0
    dense = np.zeros((NX, NY, NY))
    for j, k in np.ndindex(NY, WIDTH):
        if 0 <= j + k - REACH < NY:
            dense[:, j, j + k - REACH] = bands[j, k]
        else:
            bands[j, k] = np.nan
    bands.transpose(0, 2, 1)[~inside] = np.nan
    r = rng.standard_normal((NY, NX))
    w = r.copy()
    factor_y_bands(bands, spans)
    solve_y_bands(bands, spans, columns, w)
    for i in range(NX):
        if not columns[0] <= i < columns[1]:
            np.testing.assert_array_equal(w[:, i], r[:, i])
            continue
        own, expected = np.flatnonzero(inside[:, i]), np.zeros(NY)
        expected[own] = np.linalg.solve(dense[i][np.ix_(own, own)], r[own, i])
        np.testing.assert_allclose(w[:, i], expected, rtol=1e-12, atol=1e-14)


def test_a_singular_y_line_has_factors_that_are_not_finite():
    bands = np.zeros((NY, WIDTH, NX))
    factor_y_bands(bands, np.tile([0, NX], (NY, 1)))
    assert not np.isfinite(bands[:, REACH]).any()
