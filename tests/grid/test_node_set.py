"""Nodes that all ranks know; on several ranks see `tests/parallel`."""

import numpy as np
import pytest

from mgehl.grid.node_set import NodeSet

OFFSETS = np.array([(0, 0), (0, -2), (1, 0), (-1, 1)])


@pytest.fixture
def grid(make_hierarchy, paper_contact):
    """5 lines of 9 nodes."""
    return make_hierarchy(paper_contact(), nodes=9, ny=5, coarsest=9).grids[-1]


@pytest.fixture
def mask(grid):
    mask = np.zeros(grid.shape, dtype=bool)
    mask[0, 8] = mask[2, 3] = mask[4, 0] = True
    return mask


def test_values_are_in_the_order_of_the_lines(grid, mask):
    nodes = NodeSet.where(grid, mask)
    array = np.arange(2 * grid.mesh.nodes).reshape(2, *grid.shape)
    assert len(nodes) == 3
    np.testing.assert_array_equal(nodes.values(array), array[:, mask])


def test_values_are_added_in_place(grid, mask):
    array = np.zeros(grid.shape)
    NodeSet.where(grid, mask).add(array, np.array([1.0, 2.0, 3.0]))
    assert (array[0, 8], array[2, 3], array[4, 0], array.sum()) == (1.0, 2.0, 3.0, 6.0)


def test_what_is_around_them_ends_with_the_domain(grid, mask):
    expected = np.zeros(grid.shape, dtype=bool)
    for line, node in np.argwhere(mask):
        for there in OFFSETS + (line, node):
            if all(0 <= there) and there[0] < 5 and there[1] < 9:
                expected[tuple(there)] = True
    around = NodeSet.where(grid, mask).around(OFFSETS)
    marked = np.zeros(grid.shape)
    around.add(marked, np.ones(len(around)))
    np.testing.assert_array_equal(marked, expected)


def test_the_matrix_is_that_of_the_stencil(grid, mask):
    nodes = NodeSet.where(grid, mask)
    columns = nodes.around(OFFSETS)
    stencil, field = np.random.default_rng(4).standard_normal((2, 4, *grid.shape))
    product = nodes.matrix(nodes.values(stencil).T, columns, OFFSETS) @ columns.values(field[0])
    for found, (line, node) in zip(product, np.argwhere(mask), strict=True):
        expected = 0.0
        for k, there in enumerate(OFFSETS + (line, node)):
            if all(0 <= there) and there[0] < 5 and there[1] < 9:
                expected += stencil[k, line, node] * field[0][tuple(there)]
        assert found == pytest.approx(expected, rel=1e-13)
