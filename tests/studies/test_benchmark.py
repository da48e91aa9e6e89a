"""Timings of fixed cases: their work is exact, their parts add up, two commits compare as ratios."""

import pytest
from mpi4py import MPI

from mgehl.errors import OutputError
from mgehl.studies.benchmark import (
    measure,
    read_benchmark,
    write_benchmark,
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


def test_a_benchmark_is_read_back_as_it_was_written(measured, tmp_path):
    write_benchmark(tmp_path / "now.json", measured)
    assert read_benchmark(tmp_path / "now.json") == measured


@pytest.mark.parametrize("text", ["", "{}", '{"ranks": 1, "versions": {}, "timings": [{"case": "a"}]}'])
def test_a_file_that_is_no_benchmark_is_one_line(tmp_path, text):
    (tmp_path / "old.json").write_text(text)
    with pytest.raises(OutputError, match="old.json: no benchmark") as caught:
        read_benchmark(tmp_path / "old.json")
    assert "\n" not in str(caught.value)
