"""How film and contact share, of states made by hand: patches, areas, shares, films."""

from dataclasses import replace

import numpy as np
import pytest

from mgehl.discretization.mesh import Mesh
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.model.surface import Waviness
from mgehl.output.mixed_result import Nodes, measured, patch_sizes
from mgehl.solver.gaps import within_hertz

FILM, LOW = 0.5, 0.25
WAVES = Waviness(100e-9, 1e-4, None)
MESH = Mesh(17, 9, (-2.0, 2.0), (-2.0, 2.0), 1.0)
"""dX = 1/4, dY = 1/2."""


@pytest.fixture
def contact(paper_contact):
    return paper_contact(surface=WAVES)


@pytest.fixture
def nodes():
    """A film of one thickness without pressure on level heights, inside a boundary."""
    status = np.full((9, 17), LUBRICATED)
    status[[0, -1]], status[:, [0, -1]] = BOUNDARY, BOUNDARY
    level = [np.zeros((9, 17)) for _ in range(3)]
    return Nodes(level[0], np.full((9, 17), FILM), status, level[1], level[2], np.ones((9, 17)))


def touch(nodes, *places, P=1.0):
    for j, i in places:
        nodes.status[j, i], nodes.P[j, i], nodes.H[j, i] = CONTACT, P, 0.0


@pytest.mark.parametrize(
    "drawing, sizes",
    [
        (["..", ".."], []),
        (["#.#", "...", "#.."], [1, 1, 1]),
        (["#..", ".#.", "..#"], [3]),
        (["##.#", "...#"], [2, 2]),
        (["#.##.#"], [1, 2, 1]),
    ],
)
def test_patches_hang_together_by_sides_and_by_corners(drawing, sizes):
    solid = np.array([[letter == "#" for letter in line] for line in drawing])
    assert patch_sizes(solid) == sizes


def test_areas_and_the_largest_patch_are_in_square_metres(contact, nodes):
    touch(nodes, (4, 8), (5, 9), (2, 3))
    found = measured(contact, MESH, nodes)
    cell = 0.25 * 0.5
    assert found.patches == 2
    assert found.contact_area_m2 == pytest.approx(3 * cell * contact.hertz.a**2)
    assert found.largest_patch_m2 == pytest.approx(2 * cell * contact.hertz.a**2)
    assert found.contact_area_over_hertz == pytest.approx(3 * cell / np.pi)


@pytest.mark.parametrize("rows", [9, 1], ids=["point", "line"])
def test_sealed_is_what_no_path_leads_out_of(contact, rows):
    """A path goes from node to node by their sides and out over the edge; of a line over its ends."""
    chance = np.random.default_rng(46)
    mesh = MESH if rows > 1 else Mesh(17, 1, (-2.0, 2.0), (-0.5, 0.5))
    for _ in range(20):
        solid, P = chance.random((rows, 17)) < 0.45, chance.random((rows, 17))
        status = np.where(solid, CONTACT, np.where(chance.random(solid.shape) < 0.3, CAVITATED, LUBRICATED))
        level = np.zeros(solid.shape)
        nodes = Nodes(P, level + FILM, status, level, P, level + 1.0)
        reached = [
            (j, i)
            for j in range(rows)
            for i in range(17)
            if not solid[j, i] and (i in (0, 16) or (rows > 1 and j in (0, rows - 1)))
        ]
        for j, i in reached:  # grows as it is walked
            for near in ((j, i - 1), (j, i + 1), (j - 1, i), (j + 1, i)):
                inside = 0 <= near[0] < rows and 0 <= near[1] < 17
                if inside and not solid[near] and near not in reached:
                    reached.append(near)
        load = P[~solid].sum() - sum(P[each] for each in reached)
        found = measured(contact, mesh, nodes).sealed_load_fraction
        assert found == pytest.approx(load * mesh.dX * mesh.dY / contact.load_integral, abs=1e-12)


def test_what_there_is_not_is_none(contact, nodes):
    touch(nodes, *np.argwhere(within_hertz(MESH)))
    found = measured(replace(contact, surface=Waviness(0.0, 1e-4, None)), MESH, nodes)
    assert (found.mean_film_nm, found.minimum_film_nm, found.valley_film_nm) == (None, None, None)
    assert found.lambda_ratio is None and found.torn_filling is None and found.torn_share == 0.0
