import numpy as np
import pytest

from mgehl.multigrid.cliffs import BESIDE, CliffZone
from mgehl.multigrid.nearby import NearbySolve
from mgehl.multigrid.smoother import influence_nearby

SHARE, NODES = 0.25, 17


@pytest.fixture
def matrix(jacobian, masks):
    """The near part of J Q, as the solve of all nearby nodes has it."""
    everywhere = np.ones(jacobian.grid.shape, dtype=bool)
    nearby = NearbySolve(jacobian, influence_nearby(jacobian), SHARE, everywhere)
    yield nearby.matrix(*(jacobian.grid.halo(mask) for mask in masks))[:, :]
    nearby.free()


@pytest.fixture
def solved(jacobian, masks):
    """Function: w after the solve of the zone around some nodes, the weighted residual and w before."""

    def solve(found):
        zone = CliffZone(jacobian.grid, influence_nearby(jacobian), SHARE)
        zone.gather(found, jacobian.linearisation, *masks)
        zone.factor()
        r, before = np.random.default_rng(3).standard_normal((2, NODES, NODES))
        w = before.copy()
        zone.solve(r, w, 1.5)
        return w, 1.5 * r, before

    return solve


def test_rows_around_cliffs_hold_and_the_rest_is_left_alone(solved, matrix):
    found, zone = np.zeros((2, NODES, NODES), dtype=bool)
    for j, i in ((8, 9), (0, 4), (12, NODES - 1)):
        found[j, i] = True
        zone[max(j - BESIDE, 0) : j + BESIDE + 1, max(i - BESIDE, 0) : i + BESIDE + 1] = True
    w, r, before = solved(found)
    np.testing.assert_array_equal(w[~zone], before[~zone])
    left = (r.ravel() - matrix @ w.ravel()).reshape(r.shape)
    assert np.abs(left[zone]).max() < 1e-9 < np.abs(left[~zone]).max()


def test_a_singular_zone_is_left_to_the_lines(jacobian, masks, solved):
    jacobian.linearisation.A[:] = jacobian.linearisation.B[:] = 0.0
    w, _, before = solved(np.ones((NODES, NODES), dtype=bool))
    np.testing.assert_array_equal(w, before)
