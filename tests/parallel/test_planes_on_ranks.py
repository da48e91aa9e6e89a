"""Lines and columns of ranks that share their memory, and of ranks that send each other what they have.

Run as `mpiexec -n 2 python -m pytest -m parallel`.
"""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.grid import plane
from mgehl.run import solve
from mgehl.studies.study import papers_grid

pytestmark = pytest.mark.parallel

COMM = MPI.COMM_WORLD
FILM = {"motion": {"speed": 1.0}, "grid": papers_grid(65)}


def test_a_film_is_the_same_to_the_last_digit(monkeypatch):
    config = config_from_tables(FILM)
    shared = solve(config, COMM)
    monkeypatch.setattr(plane, "shared_array", lambda *_: None)
    sent = solve(config, COMM)
    assert shared.result.converged and sent.result.work == shared.result.work
    for name in ("P", "H", "status") if COMM.rank == 0 else ():
        np.testing.assert_array_equal(getattr(sent.fields, name), getattr(shared.fields, name))
