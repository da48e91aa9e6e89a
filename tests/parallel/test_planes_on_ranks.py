"""Lines and columns of ranks that share their memory, and of ranks that send each other what they have.

Run as `mpiexec -n 2 python -m pytest -m parallel`.
"""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.discretization.bands import influence_of_columns
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.residual import Linearisation
from mgehl.grid import plane, shared_memory
from mgehl.grid.plane import SentPlane, SharedPlane
from mgehl.grid.shared_memory import shared_array
from mgehl.model.deformation import HalfSpace
from mgehl.multigrid.y_bands import YBands
from mgehl.run import solve
from mgehl.studies.study import papers_grid

pytestmark = pytest.mark.parallel

COMM = MPI.COMM_WORLD
NX, NY = 17, 65
FILM = {"motion": {"speed": 1.0}, "grid": papers_grid(65)}


@pytest.fixture(params=["shared", "sent", "sent where it is large"])
def kind(request, monkeypatch):
    """The class of planes that is made; of large ones where the shared memory has room for small ones."""
    if request.param != "sent" and not shared_memory.DIRECTORY.is_dir():
        pytest.skip("files are no memory here")
    if request.param == "shared":
        return SharedPlane
    room = NY if "large" in request.param else 0

    def scarce(comm, shape, dtype):
        return shared_array(comm, shape, dtype) if shape[0] <= room else None

    monkeypatch.setattr(plane, "shared_array", scarce)
    return SentPlane


@pytest.fixture
def grids(make_grid):
    """A grid on one rank, and on all."""
    return [make_grid(Mesh(NX, NY, (-1.9, 1.3), (-1.5, 1.5)), comm) for comm in (MPI.COMM_SELF, COMM)]


def solved_y_lines(grid, moving):
    """Right-hand sides solved on the y-lines of a random system, and how many a rank has; `moving`,
    (NY, NX), are the nodes that are not given."""
    rng = np.random.default_rng(1)
    offsets = np.array([(0, 0), (0, -1), (0, 1), (-1, 0), (1, 0)])
    A, B = rng.standard_normal((2, len(offsets), NY, NX))
    A[0] += 12.0
    distributive, r = moving & (rng.random((NY, NX)) < 0.5), rng.standard_normal((NY, NX))
    kappa = influence_of_columns(influence_coefficients(grid.mesh, HalfSpace(0.2)), 0.25)
    mine, w, share = slice(grid.first, grid.last), np.empty(grid.shape), 0
    if grid.has_lines:
        y_bands = YBands(grid, kappa, 0.25)
        lin = Linearisation(offsets, *(each[:, mine].copy() for each in (A, B)), None)
        for _ in range(2):  # the second time over what was there
            y_bands.factor(lin, distributive[mine], ~moving[mine])
            y_bands.solve(r[mine], w)
        first, end = y_bands._shares[grid.team.rank]
        share = end - first
        y_bands.forget()
    return np.concatenate(grid.comm.allgather(w)), grid.comm.allgather(share)


@pytest.mark.parametrize("columns", [NX, NX // 3], ids=["everywhere", "in the first third of the plane"])
def test_y_lines_are_solved_as_by_one_rank(kind, grids, columns):
    """To the last bit; where something moves on few of them each rank has its share of those."""
    moving = np.zeros((NY, NX), bool)
    moving[1:-1, 1:columns] = True
    moving[:4] &= np.arange(NX) < NX // 4
    (expected, _), (found, shares) = (solved_y_lines(each, moving) for each in grids)
    np.testing.assert_array_equal(found, expected)
    assert found.any() and sum(shares) == NX
    assert COMM.size == 1 or columns == NX or shares[-1] > 2 * NX // 3


def test_a_film_is_the_same_to_the_last_digit(monkeypatch):
    config = config_from_tables(FILM)
    shared = solve(config, COMM)
    monkeypatch.setattr(plane, "shared_array", lambda *_: None)
    sent = solve(config, COMM)
    assert shared.result.converged and sent.result.work == shared.result.work
    for name in ("P", "H", "status") if COMM.rank == 0 else ():
        np.testing.assert_array_equal(getattr(sent.fields, name), getattr(shared.fields, name))
