"""What an iteration sends and reckons, against what MPI and PETSc counted."""

from dataclasses import replace

import pytest

from mgehl.cli import main
from mgehl.studies.rank_model import Constants, iteration, levels

COUNTED = {(129, 4): (28, 30), (257, 8): (40, 98), (65, 16): (12 + 6, 74)}
"""Messages of an iteration, of the rank that sends most, counted in Grid.halo, Move (lines that move) and
the exchanges: the difference of 7 and 2 iterations over 5."""


@pytest.mark.parametrize("case", COUNTED)
def test_messages_are_those_that_were_counted(case):
    cost = iteration(*case)
    assert (cost.halos, cost.exchanged) == COUNTED[case]


@pytest.mark.parametrize("case, bytes_counted", [((129, 4), 195648 + 39360), ((257, 8), 466520 + 88704)])
def test_bytes_are_those_that_were_counted_but_for_lines_that_ranks_share_unevenly(case, bytes_counted):
    assert iteration(*case).bytes == pytest.approx(bytes_counted, rel=0.05)


def test_one_rank_sends_nothing():
    cost = iteration(513, 1)
    assert cost.messages == 0.0 and cost.bytes < 100.0


def test_work_is_shared():
    one, many = iteration(1025, 1), iteration(1025, 4)
    assert many.transforms == pytest.approx(one.transforms / 4, rel=0.05)


def test_coarse_grids_are_shared_by_fewer():
    workers = [level.ranks for level in levels(16385, 512)]
    assert workers == sorted(workers) and workers[-1] == 512 and workers[0] == 8


def test_what_nothing_delays_takes_the_time_of_its_flops():
    ideal = Constants(0.0, 0.0, 1e30, 1e9, 1e9, 0.0, 0.0)
    cost = iteration(257, 4)
    assert sum(cost.seconds(ideal)) == pytest.approx(1e-9 * (cost.transforms + cost.sweeps), rel=1e-9)
    slow = replace(ideal, latency=1e-3)
    assert sum(cost.seconds(slow)) > 1e-3 * cost.halos


def test_one_rank_has_no_messages_to_measure(tmp_path, capsys):
    assert main(["study", "ranks", "--nodes", "65", "--quiet", "--out", str(tmp_path / "here")]) == 2
    assert "mpiexec -n 2" in capsys.readouterr().err
