"""More ranks than a coarse grid has work for give the films of one rank.

A serial test that starts the ranks itself, more of them than there are cores.
"""

import pickle
import sys

import numpy as np
import pytest
from mpi4py import MPI
from processes import ended

from mgehl.config import config_from_tables
from mgehl.run import solve
from mgehl.studies.study import PAPER, papers_grid

RANKS = 5
CASES = {
    "film on coarse grids, too": {"motion": {"speed": 8.0}, "grid": papers_grid(129)},
    "contact": PAPER | {"motion": {"speed": 5e-6}, "grid": papers_grid(65), "solver": {"start": "contact"}},
    "wedge": {"contact": {"kind": "wedge"}, "wedge": {"pillar": "square"}, "grid": {"nodes": 65}},
}
SOLVE_ALL = """
import pickle, sys
from mpi4py import MPI
from mgehl.config import config_from_tables
from mgehl.run import solve
found = {name: solve(config_from_tables(tables), MPI.COMM_WORLD) for name, tables in %r.items()}
if MPI.COMM_WORLD.rank == 0:
    with open(sys.argv[1], "wb") as file:
        pickle.dump({name: (each.fields, each.result) for name, each in found.items()}, file)
"""


@pytest.fixture(scope="module")
def together(tmp_path_factory):
    """(fields, result) of all cases by many ranks, which are started once."""
    directory = tmp_path_factory.mktemp("together")
    script, found = directory / "solve_all.py", directory / "found"
    script.write_text(SOLVE_ALL % CASES)
    done = ended(["mpiexec", "-n", str(RANKS), sys.executable, str(script), str(found)], timeout=300)
    assert done.returncode == 0, done.stderr
    return pickle.loads(found.read_bytes())


@pytest.mark.parametrize("case", CASES)
def test_they_give_the_films_of_one(together, case):
    alone = solve(config_from_tables(CASES[case]), MPI.COMM_SELF)
    (fields, result), one, expected = together[case], alone.result, alone.fields
    assert result.ranks == RANKS and result.converged and one.converged
    np.testing.assert_array_equal(fields.status, expected.status)
    np.testing.assert_allclose(fields.H, expected.H, rtol=0.0, atol=1e-9 * np.abs(expected.H).max())
    np.testing.assert_allclose(fields.P, expected.P, rtol=0.0, atol=1e-8)
    if case != "wedge":
        assert result.work == one.work
        films = result.central_film_nm, result.minimum_film_nm
        assert films == pytest.approx((one.central_film_nm, one.minimum_film_nm), rel=1e-9, abs=1e-9)
