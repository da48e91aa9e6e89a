"""Lines along Y of nodes whose lines along X are given; several ranks are tested in tests/parallel."""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.discretization.mesh import Mesh
from mgehl.grid import y_lines as module
from mgehl.grid.grid import single_grid
from mgehl.grid.y_lines import YLines

NX, NY = 7, 5


@pytest.fixture
def grid():
    made = single_grid(Mesh(NX, NY, (-1.9, 1.3), (-1.5, 1.5)), MPI.COMM_SELF)
    yield made
    made.destroy()


@pytest.fixture
def y_lines(grid):
    made = YLines(grid)
    yield made.whole
    made.destroy()


def test_y_lines_are_the_columns(y_lines):
    array = np.random.default_rng(3).random((NY, NX))
    turned = y_lines.turned(array)
    assert turned.shape == y_lines.shape == (NX, NY)
    assert turned.flags.c_contiguous
    np.testing.assert_array_equal(turned, array.T)


@pytest.mark.parametrize("kind", [bool, np.int8, float])
def test_whatever_a_double_holds_is_turned(y_lines, kind):
    array = (np.arange(NX * NY).reshape(NY, NX) % 3).astype(kind)
    np.testing.assert_array_equal(y_lines.turned(array), array.T)


def test_a_part_of_an_array_is_turned(y_lines):
    whole = np.random.default_rng(3).random((2 * NY, 3 * NX))
    part = whole[1 : NY + 1, 2 : NX + 2]
    np.testing.assert_array_equal(y_lines.turned(part), part.T)


def test_turned_back_is_what_it_was(y_lines):
    array, back = np.random.default_rng(3).random((NY, NX)), np.empty((NY, NX))
    turned = y_lines.turned(array)
    y_lines.turned(array + 1.0)  # what was turned does not change with what is turned next
    y_lines.turn_back(turned, back)
    np.testing.assert_array_equal(back, array)


def test_pieces_are_the_whole(grid, y_lines, monkeypatch):
    monkeypatch.setattr(module, "PIECE", 2 * NY + 1)
    array = np.random.default_rng(3).random((NY, NX))
    whole, parts = y_lines.turned(array), YLines(grid).pieces
    assert len(parts) == 4 and parts[0][0].start == 0 and parts[-1][0].stop == NX
    for lines, piece in parts:
        np.testing.assert_array_equal(piece.turned(array), whole[lines])
