"""Lines and columns of ranks that share their memory, and of ranks that send each other what they have.

Run as `mpiexec -n 2 python -m pytest -m parallel`.
"""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.discretization.mesh import Mesh
from mgehl.grid import plane, shared_memory, y_lines
from mgehl.grid.grid import single_grid
from mgehl.grid.plane import SentPlane, SharedPlane, even_widths, plane_of
from mgehl.grid.shared_memory import shared_array
from mgehl.grid.y_lines import YLines
from mgehl.run import solve
from mgehl.studies.study import papers_grid

pytestmark = pytest.mark.parallel

COMM = MPI.COMM_WORLD
NX, NY = 17, 65
FILM = {"motion": {"speed": 1.0}, "grid": papers_grid(65)}


@pytest.fixture(params=["shared", "sent"])
def kind(request, monkeypatch):
    """The class of planes that is made."""
    if request.param == "shared":
        if not shared_memory.DIRECTORY.is_dir():
            pytest.skip("files are no memory here")
        return SharedPlane
    monkeypatch.setattr(plane, "shared_array", lambda *_: None)
    return SentPlane


@pytest.fixture
def grid():
    made = single_grid(Mesh(NX, NY, (-1.9, 1.3), (-1.5, 1.5)), COMM)
    yield made
    made.destroy()


@pytest.fixture
def whole():
    return np.random.default_rng(1).random((NY, NX))


def test_all_ranks_see_what_one_writes():
    array = shared_array(COMM, (COMM.size, 3), float)
    assert array is not None and not array.any()
    COMM.Barrier()
    array[COMM.rank] = COMM.rank + 1.0
    COMM.Barrier()
    np.testing.assert_array_equal(array.sum(axis=1), 3.0 * np.arange(1, COMM.size + 1))


def test_where_one_rank_has_no_room_none_has(monkeypatch):
    if COMM.rank == COMM.size - 1:
        monkeypatch.setattr(shared_memory, "_mapped", lambda *_: None)
    assert shared_array(COMM, (3, 5), float) is None


def test_columns_have_what_all_wrote_to_their_lines(kind):
    starts = np.array([0, *range(2, COMM.size + 1), 2 * COMM.size + 1])
    lines, columns = int(starts[-1]), 3 * COMM.size + 1
    expected = np.arange(lines * columns).reshape(lines, columns) * (1.0 + 2.0j)
    mine = slice(*starts[COMM.rank : COMM.rank + 2])
    made = plane_of(COMM, starts, even_widths(columns, COMM.size), complex)
    try:
        assert isinstance(made, kind) or COMM.size == 1
        for factor in (1.0, 2.0):  # the second time over what was there
            made.lines[:] = factor * expected[mine]
            made.to_columns()
            first = made.starts[COMM.rank]
            here = slice(first, first + made.columns.shape[1])
            np.testing.assert_array_equal(made.columns, factor * expected[:, here])
            made.columns[:] += 1.0
            made.to_lines()
            np.testing.assert_array_equal(made.lines, factor * expected[mine] + 1.0)
    finally:
        made.destroy()


def test_lines_along_y_are_whole_on_a_rank(kind, grid, whole):
    lines = YLines(grid) if grid.has_lines else None
    mine = whole[grid.first : grid.last]
    turned, back = np.empty((0, NY)), np.empty_like(mine)
    if lines:
        turned = lines.whole.turned(mine)
        lines.whole.turned(mine + 1.0)
        lines.whole.turn_back(2.0 * turned, back)
        lines.whole.turn_back(3.0 * turned, np.empty_like(mine))  # which does not change what came before
        lines.destroy()
    np.testing.assert_array_equal(np.concatenate(COMM.allgather(turned)), whole.T)
    np.testing.assert_array_equal(back, 2.0 * mine)


def test_pieces_of_the_y_lines_are_the_whole(kind, grid, whole, monkeypatch):
    monkeypatch.setattr(y_lines, "PIECE", NX * NY // (3 * COMM.size))
    turned = np.empty((0, NY))
    if grid.has_lines:
        lines, mine = YLines(grid), whole[grid.first : grid.last]
        turned = np.concatenate([piece.turned(mine) for _, piece in lines.pieces])
        assert len(lines.pieces) > 1
        lines.destroy()
    np.testing.assert_array_equal(np.concatenate(COMM.allgather(turned)), whole.T)


def test_y_lines_that_were_dealt_out_anew_are_whole(kind, grid, whole, monkeypatch):
    """All of the work is in the first third of the lines, so the last rank has most of the others."""
    monkeypatch.setattr(y_lines, "PIECE", NX * NY // (3 * COMM.size))
    work, mine = np.where(np.arange(NX) < NX // 3, 1.0, 0.01), whole[grid.first : grid.last]
    turned, pieces, back = np.empty((0, NY)), np.empty((0, NY)), np.empty_like(mine)
    if grid.has_lines:
        lines = YLines(grid)
        assert lines.follow(work) == (COMM.size > 1) and not lines.follow(work)
        turned = lines.whole.turned(mine)
        pieces = np.concatenate([piece.turned(mine) for _, piece in lines.pieces])
        lines.whole.turn_back(2.0 * turned, back)
        lines.destroy()
    everywhere = COMM.allgather(turned)
    np.testing.assert_array_equal(np.concatenate(everywhere), whole.T)
    np.testing.assert_array_equal(np.concatenate(COMM.allgather(pieces)), whole.T)
    np.testing.assert_array_equal(back, 2.0 * mine)
    assert COMM.size == 1 or len(everywhere[-1]) > 2 * NX // 3


def test_a_film_is_the_same_to_the_last_digit(monkeypatch):
    config = config_from_tables(FILM)
    shared = solve(config, COMM)
    monkeypatch.setattr(plane, "shared_array", lambda *_: None)
    sent = solve(config, COMM)
    assert shared.result.converged and sent.result.work == shared.result.work
    for name in ("P", "H", "status"):
        np.testing.assert_array_equal(getattr(sent.local, name), getattr(shared.local, name))
