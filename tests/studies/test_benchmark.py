import pytest
from mpi4py import MPI

from mgehl.studies.benchmark import (
    measure,
)


@pytest.fixture(scope="module")
def measured():
    return measure(["line-4097", "wedge-257"], 1, MPI.COMM_SELF)


def test_a_line_contact_is_measured(measured):
    line, _ = measured.timings
    assert line.case == "line-4097" and line.converged
    assert line.convolutions > 50 and line.steps > 10
    assert line.memory_MiB > 50.0
    for part in ("set-up", "deflection", "line solves", "assembly", "transfers", "coarse solve", "I/O"):
        assert line.parts[part] > 0.0, part
    assert line.parts["Krylov"] > 0.0
