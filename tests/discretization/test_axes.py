"""Faces and nodes along X and along Y by the same words."""

import numpy as np
import pytest
from handmade import ALONG, Row

from mgehl.discretization.axes import HALO, axes_of, few_lines, own
from mgehl.discretization.mesh import Mesh

along_both = pytest.mark.parametrize("along", ALONG)
LINES, NX = 4, 7


def numbered():
    """Ghosted nodes whose value is 100 line + node, counted from the rank's first own line."""
    return 100.0 * np.arange(-HALO, LINES + HALO)[:, None] + np.arange(NX)


def step(along):
    """What a node further along the axis adds."""
    return 1.0 if along == "x" else 100.0


@pytest.mark.parametrize(
    "lines, few, expected", [(5, 2, [2, 2, 1]), (4, 2, [2, 2]), (3, 9, [3]), (0, 2, [])]
)
def test_few_lines_are_all_lines_in_order(lines, few, expected, monkeypatch):
    monkeypatch.setattr("mgehl.discretization.axes.FEW", few * NX + NX // 2)
    array = np.zeros((lines, NX))
    parts = [array[some] for some in few_lines(array)]
    assert [len(part) for part in parts] == expected
    for part in parts:
        part += 1.0
    assert (array == 1.0).all()


@along_both
def test_faces_of_some_lines(along):
    """The same that the nodes of these lines alone have."""
    axis, array, lines = Row(along).axis(), numbered(), slice(1, 3)
    part = array[lines.start : lines.stop + 2 * HALO]
    np.testing.assert_array_equal(axis.of_lines(axis.at(array), lines), axis.at(part))


def test_own_lines_are_a_view():
    array = numbered()
    own(array)[:] = 0.0
    assert own(array).shape == (LINES, NX)
    assert array[HALO - 1].all() and array[-HALO].any() and not array[HALO:-HALO].any()


def test_faces_along_x_lie_in_own_lines_those_along_y_also_before_and_after():
    array = numbered()
    x, y = Row("x").axis(), Row("y").axis()
    assert x.faces(array) == NX - 1 and y.faces(array) == LINES + 1
    np.testing.assert_array_equal(x.at(array), own(array)[:, :-1])
    np.testing.assert_array_equal(y.at(array), array[HALO - 1 : -HALO])


@along_both
@pytest.mark.parametrize("shift", [-1, 0, 1, 2])
def test_nodes_beside_a_face_are_as_far_apart_as_their_shifts(along, shift):
    axis, array = Row(along).axis(), numbered()
    first, last = axis.reachable(array, [shift])
    here, there = axis.at(array, 0, first, last), axis.at(array, shift, first, last)
    np.testing.assert_array_equal(there - here, shift * step(along))


def test_what_is_reachable():
    """A line ends; across lines the two ghosts are as far as any scheme looks."""
    x, y, array = Row("x").axis(), Row("y").axis(), numbered()
    assert x.reachable(array, []) == x.reachable(array, [0, 1]) == (0, NX - 1)
    assert x.reachable(array, [-1]) == (1, NX - 1)
    assert x.reachable(array, [2]) == (0, NX - 2)
    assert x.reachable(array, [-1, 2]) == (1, NX - 2)
    assert x.reachable(array[:, :2], [-1, 2]) == (1, 0)
    assert y.reachable(array, [-1, 2]) == y.reachable(array, []) == (0, LINES + 1)


@along_both
def test_faces_first_to_last_are_the_same_of_nodes_and_of_faces(along):
    axis, array = Row(along).axis(), numbered()
    part = axis.of_faces(axis.at(array).copy(), 1, 3)
    np.testing.assert_array_equal(part, axis.at(array, 0, 1, 3))


@along_both
def test_inner_nodes_lie_between_the_faces_that_enter_and_leave_them(along):
    """A face is known by its W, which is the node itself or the one before."""
    axis, array = Row(along).axis(), numbered()
    west = axis.at(array)
    inner = axis.inner(own(array))
    np.testing.assert_array_equal(axis.left(west), inner)
    np.testing.assert_array_equal(axis.entered(west), inner - step(along))
    for shift in (-1, 0, 1):
        np.testing.assert_array_equal(axis.neighbour(array, shift), inner + shift * step(along))


@along_both
@pytest.mark.parametrize("shift", [-2, 1])
def test_offset_is_lines_and_nodes(along, shift):
    line, node = Row(along).axis().offset(shift)
    assert 100.0 * line + node == shift * step(along)


def test_axes_of_a_plane_mesh():
    """Couette flow k_e rho H and Poiseuille flow k_e^2 eps dP/dY cross a line [Liu eq. 26]."""
    mesh = Mesh(5, 9, (0.0, 2.0), (0.0, 2.0), k_e=0.5)
    x, y = axes_of(mesh, (0.6, 0.8))
    assert (x.number, x.cell, x.distance, x.couette) == (1, 0.5, 0.5, 0.6)
    assert (y.number, y.cell, y.distance, y.couette) == (0, 0.25, 0.25 / 0.25, 0.4)


def test_a_single_line_has_one_axis_and_edges_are_its_distances():
    (x,) = axes_of(Mesh(3, 1, (0.0, 2.0), (0.0, 0.0), edges=(0.5, 1.75)), (1.0, 0.0))
    assert x.cell == 1.0 and x.distance.tolist() == [0.5, 0.75]
