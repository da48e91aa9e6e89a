"""mgehl.model.wedge; its film without a pillar is solved in closed form in wedge_series."""

from dataclasses import replace

import numpy as np
import pytest

from mgehl.model.wedge import Pocket, WedgeBearing

BEARING = WedgeBearing(exit=4e-3, inlet=8e-3, width=4e-3, slope=1e-3, viscosity=0.05, speed=0.3)
TURNED = replace(BEARING, turned=True)


def coordinates(bearing, nodes):
    x, _ = bearing.placement(nodes)
    return np.linspace(*x, nodes)


def test_turned_bearing_is_the_mirror_image():
    """Nodes, edges and gap; its plate drags the fluid towards +X, again into the narrowing film."""
    X, turned = coordinates(BEARING, 65), coordinates(TURNED, 65)
    np.testing.assert_allclose(turned, -X[::-1], rtol=1e-15)
    assert TURNED.placement(65)[1] == (-8.0, -4.0)
    np.testing.assert_allclose(TURNED.gap(turned), BEARING.gap(X)[::-1], rtol=1e-15)
    assert (BEARING.motion, TURNED.motion) == ((-1.0, 0.0), (1.0, 0.0))


X, Y = np.linspace(4.0, 8.0, 9)[None, :], np.linspace(-2.0, 2.0, 9)[:, None]
"""Nodes half a millimetre apart."""


def solid_nodes(bearing):
    solid = np.broadcast_to(bearing.solid(X, Y), (Y.size, X.size))
    return {(int(2 * X[0, i]), int(2 * Y[j, 0])) for j, i in np.argwhere(solid)}


SQUARE = {(di, dj) for di in range(-2, 3) for dj in range(-2, 3)}
CYLINDER = {(di, dj) for di, dj in SQUARE if di**2 + dj**2 <= 4}


@pytest.mark.parametrize("shape, offsets", [("square", SQUARE), ("cylinder", CYLINDER)])
def test_pillar_is_solid_with_its_edge(shape, offsets):
    """Side and diameter are the size: 2 mm are two nodes to each side of the centre."""
    bearing = replace(BEARING, pillar=shape, pillar_x=6.5e-3, pillar_y=-0.5e-3, pillar_size=2e-3)
    assert solid_nodes(bearing) == {(13 + di, -1 + dj) for di, dj in offsets}


@pytest.mark.parametrize("bearing, first", [(BEARING, 0), (TURNED, -1)], ids=["as it is", "turned"])
@pytest.mark.parametrize("nodes", [65, 1025])
def test_blocked_exit_is_the_layer_of_nodes_outside_the_pad(bearing, first, nodes):
    """The wall's face is the exit itself."""
    X = coordinates(bearing, nodes)[None, :]
    assert not bearing.solid(X, Y).any()
    solid = np.broadcast_to(replace(bearing, blocked_exit=True).solid(X, Y), (9, nodes))
    expected = np.zeros(nodes, dtype=bool)
    expected[first] = True
    np.testing.assert_array_equal(solid, np.broadcast_to(expected, solid.shape))


POCKETED = replace(BEARING, pocket=Pocket(2e-6, (5e-3, 7e-3), 2e-3))


@pytest.mark.parametrize("shift", [0.0, 0.01, 0.049, 0.07])
def test_a_pocket_has_its_volume_wherever_its_edges_lie_between_nodes(shift):
    """2 mm by 2 mm by 2 um, of cells 0.1 mm by 0.04 mm."""
    X, Y = np.arange(4.0 + shift, 8.0, 0.1)[None, :], np.arange(-2.0 + shift, 2.0, 0.04)[:, None]
    recess = POCKETED.mean_gap(X, Y, 0.1, 0.04) - BEARING.gap(X)
    assert recess.sum() * 0.1 * 0.04 == pytest.approx(4.0 * 2.0, rel=1e-12)
    assert recess.max() == pytest.approx(2.0, rel=1e-14) and recess.min() == 0.0


@pytest.mark.parametrize("shift", [0.0, 0.02, 0.07])
@pytest.mark.parametrize("along", [True, False])
def test_a_gap_between_nodes_is_that_of_its_parts_one_behind_the_other(shift, along):
    """carried and its cube by integrals of h^-2 and h^-3 from node to node, across edges and beside."""
    X, Y = np.arange(4.0 + shift, 8.0, 0.1)[None, :], np.arange(-2.0 + shift, 2.0, 0.1)[:, None]
    carried, cubed = POCKETED.gap_between(X, Y, 0.1, 0.1, along)
    fine = (np.arange(1000) + 0.5) / 1000 - 0.5
    for j, i in ((20, 5), (20, 10), (20, 20), (20, 30), (10, 15), (30, 25), (10, 10)):
        x, y = X[0, i] + 0.1 * fine, Y[j, 0] + 0.1 * fine
        deep = ((x > 5.0) & (x < 7.0))[None, :] & (np.abs(y) < 1.0)[:, None]
        h = X[0, i] + 2.0 * deep  # the pad's own slope is left out within a cell
        way = 1 if along else 0
        cubes = 1.0 / (h**-3.0).mean(axis=way)
        assert cubed[j, i] == pytest.approx(cubes.mean(), rel=3e-3)
        assert carried[j, i] == pytest.approx((cubes * (h**-2.0).mean(axis=way)).mean(), rel=3e-3)
