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
