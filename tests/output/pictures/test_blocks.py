"""Blocks of nodes that are drawn as one."""

import numpy as np
import pytest

from mgehl.discretization.mesh import Mesh
from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.output.pictures.blocks import MOST, Blocks


def test_blocks_of_three_by_three_and_what_is_left():
    """Seven and five nodes in blocks of three: the last hold one and two, and reach beyond."""
    mesh = Mesh(7, 5, (-1.0, 1.0), (0.0, 3.0))
    each, values = Blocks(mesh.X, mesh.Y, 3), np.arange(35).reshape(5, 7)
    np.testing.assert_array_equal(each.least(values), [[0, 3, 6], [21, 24, 27]])
    np.testing.assert_array_equal(each.largest(values), [[16, 19, 20], [30, 33, 34]])
    np.testing.assert_allclose(each.X, [mesh.X[1], mesh.X[4], mesh.X[6]], atol=1e-15)
    np.testing.assert_allclose(each.Y, [mesh.Y[1], 0.5 * (mesh.Y[3] + mesh.Y[4])], atol=1e-15)
    cell = 2.0 / 6
    assert each.extent[:2] == pytest.approx((-1.0 - cell / 2, -1.0 - cell / 2 + 9 * cell))


@pytest.mark.parametrize("nodes", [65, 701, 4097])
def test_a_grid_has_no_more_blocks_than_a_map_has_dots(nodes):
    each = Blocks(np.linspace(0.0, 1.0, nodes), np.arange(3.0))
    assert min(nodes, MOST / 2) <= len(each.X) <= MOST


def test_single_nodes_and_thin_lines_of_contact_stay():
    """Contact wins over a cavity, and that over the film, wherever it is in its block."""
    status = np.full((64, 64), LUBRICATED)
    status[40:] = CAVITATED
    nodes = [(5, 6), (50, 61), (63, 0)]
    for node in nodes:
        status[node] = CONTACT
    status[:, 33] = CONTACT
    drawn = Blocks(np.arange(64.0), np.arange(64.0), 10).largest(status)
    expected = np.full((10, 10), LUBRICATED)
    expected[5:] = CAVITATED  # lines 35 to 41 and after
    expected[:, 33 // 7] = CONTACT
    for j, i in nodes:
        expected[j // 7, i // 7] = CONTACT
    np.testing.assert_array_equal(drawn, expected)
