"""At an angle, too, the answer is that of one rank. Run as `mpiexec -n 2 python -m pytest -m parallel`."""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.discretization.mesh import Mesh
from mgehl.grid import transpose
from mgehl.grid.grid import single_grid
from mgehl.grid.transpose import YLines, pieces_of_y_lines
from mgehl.run import solve
from mgehl.studies.study import papers_grid

pytestmark = pytest.mark.parallel

COMM = MPI.COMM_WORLD
WIDE = {"nodes": 65, "x": [-1.9, 1.7], "y": [-1.8, 1.9]}
CASES = {
    "film": {"contact": {"radius_y": 25.4e-3}, "motion": {"speed": 1.0}, "grid": WIDE},
    "contact": {"motion": {"speed": 5e-6}, "grid": papers_grid(129), "solver": {"start": "contact"}},
}
ANGLES = (30.0, 110.0)
"""In the user's axes, and in others."""


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("case", CASES)
def test_films_are_those_of_one_rank(case, angle):
    tables = CASES[case] | {"motion": CASES[case]["motion"] | {"angle": angle}}
    config = config_from_tables(tables)
    together, alone = solve(config, COMM), solve(config, MPI.COMM_SELF)
    assert together.result.converged and alone.result.converged
    fields = COMM.bcast(together.fields)
    expected = alone.fields
    np.testing.assert_array_equal(fields.status, expected.status)
    np.testing.assert_allclose(fields.H, expected.H, rtol=0.0, atol=1e-9 * np.abs(expected.H).max())
    np.testing.assert_allclose(fields.P, expected.P, rtol=0.0, atol=1e-8)
    assert together.result.contact.x_nodes == alone.result.contact.x_nodes
    assert together.result.work == alone.result.work
    own = slice(together.first_line, together.first_line + len(together.local.H))
    for name in ("P", "H", "status"):
        np.testing.assert_array_equal(getattr(together.local, name), getattr(fields, name)[own])
    assert sum(COMM.allgather(own.stop - own.start)) == together.mesh.ny


def test_lines_along_y_are_whole_on_a_rank():
    nx, ny = 17, 65
    whole = np.random.default_rng(1).random((ny, nx))
    grid = single_grid(Mesh(nx, ny, (-1.9, 1.3), (-1.5, 1.5)), COMM)
    y_lines = YLines(grid) if grid.has_lines else None
    try:
        mine = whole[grid.first : grid.last]
        turned, back = np.empty((0, ny)), np.empty_like(mine)
        if y_lines:
            turned = y_lines.turned(mine)
            y_lines.turn_back(2.0 * turned, back)
        np.testing.assert_array_equal(np.concatenate(COMM.allgather(turned)), whole.T)
        np.testing.assert_array_equal(back, 2.0 * mine)
    finally:
        if y_lines:
            y_lines.destroy()
        grid.destroy()


def test_pieces_of_the_y_lines_are_the_whole(monkeypatch):
    nx, ny = 17, 65
    monkeypatch.setattr(transpose, "PIECE", nx * ny // (3 * COMM.size))
    whole = np.random.default_rng(1).random((ny, nx))
    grid = single_grid(Mesh(nx, ny, (-1.9, 1.3), (-1.5, 1.5)), COMM)
    try:
        mine = whole[grid.first : grid.last]
        parts = [some.turned(mine) for _, some in pieces_of_y_lines(grid)] if grid.has_lines else []
        turned = np.concatenate([np.empty((0, ny)), *parts])
        assert len(parts) > 1 or not grid.has_lines
        np.testing.assert_array_equal(np.concatenate(COMM.allgather(turned)), whole.T)
    finally:
        grid.destroy()
