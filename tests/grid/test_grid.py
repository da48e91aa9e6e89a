"""One grid and the hierarchy of grids, on one rank."""

import numpy as np
import pytest

from mgehl.discretization.axes import HALO, own
from mgehl.discretization.status import LUBRICATED, WALL


@pytest.fixture
def hierarchy(paper_contact, make_hierarchy):
    return make_hierarchy(paper_contact(), 129)


def beyond(ghosted):
    """The ghost lines."""
    return np.concatenate([ghosted[:HALO], ghosted[-HALO:]])


def test_hierarchy_halves_the_grids_down_to_the_coarsest(hierarchy):
    assert [grid.mesh.nx for grid in hierarchy.grids] == [33, 65, 129]
    assert [grid.mesh.ny for grid in hierarchy.grids] == [33, 65, 129]
    assert len(hierarchy.transfers) == 2
    assert len(hierarchy.deflections) == 3


def test_coarse_nodes_are_every_other_fine_node(hierarchy):
    coarse, fine = hierarchy.grids[0], hierarchy.grids[1]
    np.testing.assert_allclose(coarse.X, fine.X[:, ::2], atol=1e-14)
    np.testing.assert_allclose(coarse.Y, fine.Y[::2], atol=1e-14)
    assert fine.X.shape == (1, 65) and fine.Y.shape == (65, 1)


def test_convolutions_are_counted_by_node_ratio(hierarchy):
    pressures = [np.zeros(grid.shape) for grid in hierarchy.grids]
    assert hierarchy.convolutions == 0.0
    hierarchy.deflections[2](pressures[2])
    assert hierarchy.convolutions == 1.0
    hierarchy.deflections[0](pressures[0])
    assert hierarchy.convolutions == pytest.approx(1.0 + (33 / 129) ** 2, rel=1e-14)


def test_grids_of_one_line_stay_one_line(make_line):
    line = make_line(129)
    assert [(grid.mesh.nx, grid.mesh.ny) for grid in line.grids] == [(33, 1), (65, 1), (129, 1)]
    assert all(grid.mesh.is_line and grid.shape == (1, grid.mesh.nx) for grid in line.grids)
    assert [grid.Y.tolist() for grid in line.grids] == [[[0.0]]] * 3
    np.testing.assert_allclose(line.grids[0].X, line.grids[2].X[:, ::4], atol=1e-14)


@pytest.fixture(params=["plane", "line"])
def any_grid(request, hierarchy, make_line):
    """A grid of 33 lines, and one of a single line."""
    return hierarchy.grids[0] if request.param == "plane" else make_line(33).grids[0]


def test_beyond_the_domain_are_walls(any_grid):
    """In the ghost lines of a status; no pressure and no gap is beyond them."""
    status = np.full(any_grid.shape, LUBRICATED)
    ghosted = any_grid.halo_status(status)
    assert ghosted.dtype == status.dtype and ghosted.shape == any_grid.ghosted_shape
    np.testing.assert_array_equal(own(ghosted), status)
    np.testing.assert_array_equal(beyond(ghosted), WALL)
    for array in (np.ones(any_grid.shape), np.ones(any_grid.shape, dtype=bool)):
        np.testing.assert_array_equal(beyond(any_grid.halo(array)), 0)
        np.testing.assert_array_equal(own(any_grid.halo(array)), array)
