"""At an angle, too, the answer is that of one rank. Run as `mpiexec -n 2 python -m pytest -m parallel`."""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.run import solve
from mgehl.studies.study import PAPER, papers_grid

pytestmark = pytest.mark.parallel

COMM = MPI.COMM_WORLD
WIDE = {"nodes": 65, "x": [-1.9, 1.7], "y": [-1.8, 1.9]}
CASES = {
    "film": {"contact": {"radius_y": 25.4e-3}, "motion": {"speed": 1.0}, "grid": WIDE},
    "contact": PAPER
    | {"motion": {"speed": 5e-6}, "grid": papers_grid(129), "solver": {"start": "contact"}},
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
