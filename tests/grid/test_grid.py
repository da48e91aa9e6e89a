"""One grid and the hierarchy of grids, on one rank."""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.discretization.axes import HALO, own
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.status import LUBRICATED, WALL
from mgehl.grid.grid import build_grids, single_grid


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


def test_halo_surrounds_with_zero_lines_outside_the_domain(hierarchy):
    grid = hierarchy.grids[0]
    values = np.arange(33.0 * 33.0).reshape(33, 33) + 1.0
    ghosted = grid.halo(values)
    assert ghosted.shape == (33 + 2 * HALO, 33)
    np.testing.assert_array_equal(own(ghosted), values)
    np.testing.assert_array_equal(beyond(ghosted), 0.0)


def test_lines_around_are_zero_outside_the_domain(hierarchy):
    values = np.arange(33.0 * 33.0).reshape(33, 33) + 1.0
    around = hierarchy.grids[0].lines_around(values, 3)
    np.testing.assert_array_equal(around, np.pad(values, ((3, 3), (0, 0))))


@pytest.mark.parametrize("kind", [bool, np.int8, float])
def test_halo_keeps_the_type(hierarchy, kind):
    grid = hierarchy.grids[0]
    values = (np.arange(33 * 33).reshape(33, 33) % 2).astype(kind)
    ghosted = grid.halo(values)
    assert ghosted.dtype == kind
    np.testing.assert_array_equal(own(ghosted), values)


def test_halo_fills_a_given_array_and_leaves_its_argument_alone(hierarchy):
    grid = hierarchy.grids[0]
    values, out = np.ones(grid.shape, dtype=bool), np.full(grid.ghosted_shape, 7.0)
    assert grid.halo(values, out=out) is out
    np.testing.assert_array_equal(own(out), 1.0)
    np.testing.assert_array_equal(values, True)


def test_refresh_keeps_the_own_lines(hierarchy):
    grid = hierarchy.grids[0]
    ghosted = np.random.default_rng(0).random(grid.ghosted_shape)
    before = own(ghosted).copy()
    grid.refresh(ghosted)
    np.testing.assert_array_equal(own(ghosted), before)


def test_boundary_is_the_outermost_ring(hierarchy):
    boundary = hierarchy.grids[0].boundary()
    assert boundary[0].all() and boundary[-1].all() and boundary[:, 0].all() and boundary[:, -1].all()
    assert not boundary[1:-1, 1:-1].any()


def test_reductions(hierarchy):
    grid = hierarchy.grids[0]
    values = np.linspace(-2.0, 3.0, 33 * 33).reshape(33, 33)
    assert grid.max(values) == 3.0
    assert grid.min(values) == -2.0
    assert grid.count(values > 0.0) == np.count_nonzero(values > 0.0)
    assert grid.sum(2.5) == 2.5
    assert grid.value_at(values, 4, 7) == values[7, 4]


def test_reductions_of_nothing_give_the_initial_value(hierarchy):
    grid, nothing = hierarchy.grids[0], np.zeros(0)
    assert grid.max(nothing, initial=0.0) == 0.0
    assert grid.min(nothing, initial=5.0) == 5.0


def test_one_rank_gathers_what_it_has(hierarchy):
    grid = hierarchy.grids[0]
    values = np.random.default_rng(1).random(grid.shape)
    whole = grid.gather(values)
    np.testing.assert_array_equal(whole, values)


def test_several_arrays_are_gathered_and_scattered_at_once(hierarchy):
    grid = hierarchy.grids[0]
    several = np.random.default_rng(1).random((3, *grid.shape))
    whole = grid.gather(several)
    np.testing.assert_array_equal(whole, several)
    np.testing.assert_array_equal(grid.scatter(whole), several)
    assert grid.scatter(grid.gather(several[:0])).shape == (0, *grid.shape)


def test_grids_of_one_line_stay_one_line(make_line):
    line = make_line(129)
    assert [(grid.mesh.nx, grid.mesh.ny) for grid in line.grids] == [(33, 1), (65, 1), (129, 1)]
    assert all(grid.mesh.is_line and grid.shape == (1, grid.mesh.nx) for grid in line.grids)
    assert [grid.Y.tolist() for grid in line.grids] == [[[0.0]]] * 3
    np.testing.assert_allclose(line.grids[0].X, line.grids[2].X[:, ::4], atol=1e-14)


def test_boundary_of_one_line_is_its_two_ends(make_line):
    boundary = make_line(33).grids[0].boundary()
    assert np.argwhere(boundary).tolist() == [[0, 0], [0, 32]]


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


def test_a_single_grid_is_dealt_out_as_the_finest_of_many():
    mesh = Mesh(65, 65, (-1.0, 1.0), (-1.0, 1.0))
    alone, grids = single_grid(mesh, MPI.COMM_SELF), build_grids(mesh, 33, MPI.COMM_SELF)
    try:
        assert alone.mesh is mesh and alone.starts.tolist() == grids[-1].starts.tolist()
    finally:
        for grid in (alone, *grids):
            grid.destroy()
