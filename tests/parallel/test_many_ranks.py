"""More ranks than a coarse grid has work for give the films of one rank.

A serial test that starts the ranks itself, more of them than there are cores.
"""

import os
import subprocess
import sys

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.output.stored import read_run
from mgehl.run import run

RANKS = 20
CASES = {
    "film": {"motion": {"speed": 1.0}, "grid": {"nodes": 65}},
    "contact": {"motion": {"speed": 5e-6}, "grid": {"nodes": 129}, "solver": {"start": "contact"}},
    "wedge": {"contact": {"kind": "wedge"}, "wedge": {"pillar": "square"}, "motion": {"speed": 1.0},
              "grid": {"nodes": 65}},
}  # fmt: skip
SOLVE_ALL = """
import sys
from pathlib import Path
from mpi4py import MPI
from mgehl.config import config_from_tables
from mgehl.run import run
for name, tables in {cases!r}.items():
    run(config_from_tables(tables), Path(sys.argv[1]) / name, MPI.COMM_WORLD)
"""


@pytest.fixture(scope="module")
def together(tmp_path_factory):
    """Directory of the runs of all cases on many ranks."""
    directory = tmp_path_factory.mktemp("together")
    for name in CASES:
        (directory / name).mkdir()
    script = directory / "solve_all.py"
    script.write_text(SOLVE_ALL.format(cases=CASES))
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("OMPI_COMM", "PMIX_", "PRTE_"))}
    words = ["mpiexec", "-n", str(RANKS), sys.executable, str(script), str(directory)]
    done = subprocess.run(words, capture_output=True, text=True, env=environment, timeout=300)
    assert done.returncode == 0, done.stderr
    return directory


@pytest.mark.parametrize("case", CASES)
def test_they_give_the_films_of_one(together, tmp_path, case):
    run(config_from_tables(CASES[case]), tmp_path, MPI.COMM_SELF)
    many, one = read_run(together / case), read_run(tmp_path)
    assert many.result.ranks == RANKS and many.result.converged and one.result.converged
    np.testing.assert_array_equal(many.fields.status, one.fields.status)
    scale = np.abs(one.fields.H).max()
    np.testing.assert_allclose(many.fields.H, one.fields.H, rtol=0.0, atol=1e-9 * scale)
    np.testing.assert_allclose(many.fields.P, one.fields.P, rtol=0.0, atol=1e-8)
    if case != "wedge":
        assert many.result.work == one.result.work
        for film in ("central_film_nm", "minimum_film_nm"):
            assert getattr(many.result, film) == pytest.approx(
                getattr(one.result, film), rel=1e-9, abs=1e-9
            )
