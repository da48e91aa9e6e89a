"""Stencils as sparse matrices."""

import numpy as np

from mgehl.multigrid.stencil_matrix import stencil_rows


def test_stencil_rows_place_the_neighbours():
    lines, nx = 4, 5
    offsets = [(0, 0), (0, -2), (0, -1), (0, 1), (-2, 0), (-1, 0), (1, 0)]
    stencil = np.zeros((len(offsets), lines, nx))
    stencil[:, 2, 2] = 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0
    row = stencil_rows(offsets, stencil, 0, lines * nx).toarray()[2 * nx + 2].reshape(lines, nx)
    expected = np.zeros((lines, nx))
    expected[2, :4] = 2.0, 3.0, 1.0, 4.0
    expected[[0, 1, 3], 2] = 5.0, 6.0, 7.0
    np.testing.assert_array_equal(row, expected)


def test_rows_of_a_rank_are_rows_of_the_whole():
    offsets = [(0, 0), (0, -2), (0, -1), (0, 1), (-2, 0), (-1, 0), (1, 0)]
    stencil = np.random.default_rng(1).uniform(1.0, 2.0, (len(offsets), 6, 7))
    stencil[:, [0, 1, -1]] = 0.0
    stencil[:, :, [0, 1, -1]] = 0.0
    whole = stencil_rows(offsets, stencil, 0, 43).toarray()
    part = stencil_rows(offsets, stencil[:, 2:5], 2 * 7, 43).toarray()
    np.testing.assert_array_equal(part, whole[14:35])
