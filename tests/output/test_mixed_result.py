from dataclasses import replace

import numpy as np
import pytest

from mgehl.discretization.mesh import Mesh
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.model.line import LineContact
from mgehl.model.lubricant import Barus, ConstantDensity, Lubricant
from mgehl.model.surface import Waviness
from mgehl.output.fields import Fields
from mgehl.output.mixed_result import measured, patch_sizes
from mgehl.output.mixed_words import mixed_lines
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
    status = np.pad(np.full((7, 15), LUBRICATED), 1, constant_values=BOUNDARY)
    level = [np.zeros((9, 17)) for _ in range(3)]
    return Fields(level[0], np.full((9, 17), FILM), status, level[1], np.ones((9, 17)), level[2])


def touch(nodes, *places, P=1.0):
    for j, i in places:
        nodes.status[j, i], nodes.P[j, i], nodes.H[j, i] = CONTACT, P, 0.0


@pytest.mark.parametrize(
    "drawing, sizes",
    [(["..", ".."], []), (["#.#", "...", "#.."], [1, 1, 1]), (["#..", ".#.", "..#"], [3]),
     (["##.#", "...#"], [2, 2]), (["#.##.#"], [1, 2, 1])],
)  # fmt: skip
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


def test_each_carries_the_load_of_its_pressure_and_solids_what_the_fluid_does_not(contact, nodes):
    touch(nodes, (4, 8), P=2.0)
    nodes.P[4, 7], nodes.P[4, 9] = 0.5, 0.25
    nodes.P[0, 0] = 9.0  # of the boundary
    nodes.p[4, 8], nodes.p[4, 7] = 0.5, 0.5
    found = measured(contact, MESH, nodes)
    whole = 0.125 / contact.load_integral
    assert found.contact_load_share == pytest.approx(2.0 * whole)
    assert found.film_load_share == pytest.approx(0.75 * whole)
    assert found.solid_load_fraction == pytest.approx(1.5 * whole)


def test_films_are_of_the_film_within_the_ellipse_alone(contact, nodes):
    touch(nodes, (4, 8))
    nodes.H[4, 8] = 1e-3  # the boundary film of contact
    nodes.H[4, 7], nodes.H[4, 9], nodes.H[4, 2] = LOW, 40.0, 1e-4
    nodes.status[4, 9] = CAVITATED  # its gap is no film
    found, nm = measured(contact, MESH, nodes), 1e9 * contact.film_scale
    inside = within_hertz(MESH).sum()
    assert inside == 9 + 2 * 7 + 2 * 1
    assert found.minimum_film_nm == pytest.approx(LOW * nm)
    assert found.mean_film_nm == pytest.approx((LOW + (inside - 3) * FILM) / (inside - 2) * nm)
    assert found.torn_share == pytest.approx(1 / inside)


def test_valleys_are_deeper_than_sq_below_the_mean(contact, nodes):
    Sq = contact.roughness
    nodes.heights[4, 6:9] = -1.01 * Sq, -0.99 * Sq, -3.0 * Sq
    nodes.H[4, 6:9] = 0.75, 9.0, 1.25
    found = measured(contact, MESH, nodes)
    assert found.valley_film_nm == pytest.approx(1.0 * 1e9 * contact.film_scale)
    assert found.Sq_nm == pytest.approx(1e9 * Sq)
    assert found.lambda_ratio == pytest.approx(contact.formulas["hamrock_dowson_central"] / Sq)


def test_the_filling_is_that_of_cavities_within_the_ellipse(contact, nodes):
    for i, filling in ((7, 0.25), (9, 0.75), (1, 0.0)):  # the last is outside
        nodes.status[4, i], nodes.filling[4, i] = CAVITATED, filling
    assert measured(contact, MESH, nodes).torn_filling == pytest.approx(0.5)


def test_a_line_contact_has_areas_of_a_metre_of_it():
    lubricant = Lubricant(Barus(0.096, 18.2e-9), ConstantDensity())
    contact = LineContact(1e5, 12.7e-3, 219.78e9, 1.0, lubricant, WAVES)
    P, film = np.zeros((1, 17)), np.full((1, 17), FILM)
    nodes = Fields(P, film, np.full((1, 17), LUBRICATED), 0.0 * P, np.ones((1, 17)), 0.0 * P)
    touch(nodes, (0, 6), (0, 7), (0, 9))
    found = measured(contact, Mesh(17, 1, (-2.0, 2.0), (-0.5, 0.5)), nodes)
    assert found.contact_area_m2 == pytest.approx(3 * 0.25 * contact.hertz.a)
    assert found.contact_area_over_hertz == pytest.approx(3 * 0.25 / 2.0)
    assert found.contact_load_share == pytest.approx(0.75 / (np.pi / 2.0))
    lines = "\n".join(mixed_lines(found))
    assert f"{1e12 * found.contact_area_m2:.4g} um^2 in each metre" in lines
    assert "thinner than a molecule" in lines  # contact carries all of it, without layers


@pytest.mark.parametrize("rows", [9, 1], ids=["point", "line"])
def test_sealed_is_what_no_path_leads_out_of(contact, rows):
    """A path goes from node to node by their sides and out over the edge; of a line over its ends."""
    chance = np.random.default_rng(46)
    mesh = MESH if rows > 1 else Mesh(17, 1, (-2.0, 2.0), (-0.5, 0.5))
    for _ in range(20):
        solid, P = chance.random((rows, 17)) < 0.45, chance.random((rows, 17))
        status = np.where(solid, CONTACT, np.where(chance.random(solid.shape) < 0.3, CAVITATED, LUBRICATED))
        level = np.zeros(solid.shape)
        nodes = Fields(P, level + FILM, status, P, level + 1.0, level)
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


def test_films_hardly_thicker_than_contact_are_told_apart(contact, nodes):
    """A tenth thicker at the most: these may be contact on another grid."""
    touch(nodes, (4, 8), P=3.0)
    nodes.H[4, 8], nodes.H[4, 6], nodes.H[4, 10] = 0.1, 0.1099, 0.1101
    nodes.P[4, 6], nodes.P[4, 10] = 2.0, 4.0
    found = measured(contact, MESH, nodes, kept=0.1)
    cell = MESH.dX * MESH.dY / contact.load_integral
    assert found.contact_load_share == pytest.approx(3.0 * cell)
    assert found.near_contact_load_share == pytest.approx(2.0 * cell)
    percent = [f"{100.0 * part * cell:.2f} %" for part in (3.0, 2.0, 4.0)]
    assert "contact carries {} of the load, films at most a tenth thicker {}, other films {}".format(
        *percent
    ) in "\n".join(mixed_lines(found))
