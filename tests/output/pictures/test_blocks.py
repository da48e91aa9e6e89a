"""Blocks of nodes that are drawn as one."""

import numpy as np
import pytest

from mgehl.discretization.mesh import Mesh
from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.output.pictures.blocks import MOST, Blocks


def blocks(nx, ny, most):
    mesh = Mesh(nx, ny, (-1.0, 1.0), (0.0, 3.0))
    return mesh, Blocks(mesh.X, mesh.Y, most)


def test_a_small_grid_is_drawn_node_by_node():
    mesh, each = blocks(7, 5, 7)
    values = np.random.default_rng(1).random((5, 7))
    np.testing.assert_array_equal(each.least(values), values)
    np.testing.assert_array_equal(each.largest(values), values)
    np.testing.assert_array_equal(each.X, mesh.X)
    np.testing.assert_array_equal(each.Y, mesh.Y)


def test_blocks_of_three_by_three_and_what_is_left():
    """Seven and five nodes in blocks of three: the last hold one and two."""
    mesh, each = blocks(7, 5, 3)
    values = np.arange(35).reshape(5, 7)
    np.testing.assert_array_equal(each.least(values), [[0, 3, 6], [21, 24, 27]])
    np.testing.assert_array_equal(each.largest(values), [[16, 19, 20], [30, 33, 34]])
    np.testing.assert_allclose(each.X, [mesh.X[1], mesh.X[4], mesh.X[6]], atol=1e-15)
    np.testing.assert_allclose(each.Y, [mesh.Y[1], 0.5 * (mesh.Y[3] + mesh.Y[4])], atol=1e-15)


@pytest.mark.parametrize("nodes", [701, 1025, 4097])
def test_a_large_grid_has_no_more_blocks_than_a_map_has_dots(nodes):
    _, each = blocks(nodes, 3, MOST)
    assert MOST / 2 < len(each.X) <= MOST


def test_single_nodes_and_thin_lines_of_contact_stay():
    """Contact wins over a cavity, and that over the film, wherever it is in its block."""
    status = np.full((64, 64), LUBRICATED)
    status[40:] = CAVITATED
    nodes = [(5, 6), (50, 61), (63, 0)]
    for node in nodes:
        status[node] = CONTACT
    status[:, 33] = CONTACT
    _, each = blocks(64, 64, 10)
    drawn = each.largest(status)
    expected = np.full((10, 10), LUBRICATED)
    expected[5:] = CAVITATED  # lines 35 to 41 and after
    expected[:, 33 // 7] = CONTACT
    for j, i in nodes:
        expected[j // 7, i // 7] = CONTACT
    np.testing.assert_array_equal(drawn, expected)


def test_an_image_of_blocks_ends_where_their_cells_do():
    """Seven nodes in three blocks of three, the last of which reaches beyond; one block is a unit wide."""
    _, each = blocks(7, 5, 3)
    cell = 2.0 / 6
    assert each.extent[:2] == pytest.approx((-1.0 - cell / 2, -1.0 - cell / 2 + 9 * cell))
    assert each.limits[:2] == pytest.approx((each.X[0], each.X[-1]))
    single = Blocks(np.array([2.0]), np.array([1.0, 3.0]))
    assert single.extent == (1.5, 2.5, 0.0, 4.0) and single.limits == (1.5, 2.5, 1.0, 3.0)
