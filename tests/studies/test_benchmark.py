"""Timings of fixed cases: their work is exact, their parts add up, two commits compare as ratios."""

from dataclasses import replace

import pytest
from mpi4py import MPI

from mgehl.errors import OutputError
from mgehl.studies.benchmark import (
    Benchmark,
    Clocks,
    Timing,
    measure,
    ratios,
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


def test_parts_add_up_to_the_wall_time(measured):
    for timing in measured.timings:
        assert sum(timing.parts.values()) == pytest.approx(timing.time.wall, rel=1e-9)
        assert 0.0 <= timing.parts["other"] < 0.7 * timing.time.wall


def test_a_benchmark_is_read_back_as_it_was_written(measured, tmp_path):
    write_benchmark(tmp_path / "now.json", measured)
    assert read_benchmark(tmp_path / "now.json") == measured


@pytest.mark.parametrize("text", ["", "{}", '{"ranks": 1, "versions": {}, "timings": [{"case": "a"}]}'])
def test_a_file_that_is_no_benchmark_is_one_line(tmp_path, text):
    (tmp_path / "old.json").write_text(text)
    with pytest.raises(OutputError, match="old.json: no benchmark") as caught:
        read_benchmark(tmp_path / "old.json")
    assert "\n" not in str(caught.value)


def timing(**changes):
    made = Timing(
        case="film",
        converged=True,
        convolutions=100.0,
        steps=10,
        time=Clocks(4.0, 2.0),
        reference=Clocks(0.02, 0.01),
        memory_MiB=200.0,
        parts={"deflection": 3.0, "I/O": 0.01, "other": 0.99},
    )
    return replace(made, **changes)


def compared(old, new):
    return ratios(Benchmark(1, {}, [old]), Benchmark(1, {}, [new]))


def test_more_work_on_the_same_machine_shows():
    more = timing(convolutions=150.0, time=Clocks(5.0, 2.5), parts={"deflection": 4.0, "other": 1.0})
    found = compared(timing(), more)["film"]
    assert found["convolutions"] == 1.5 and found["wall"] == found["cpu"] == pytest.approx(1.25)
    assert found["deflection"] == pytest.approx(4.0 / 3.0)
