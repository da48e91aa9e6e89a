"""Tables of runs, films and gaps with their bands."""

import csv

import pytest

from mgehl.cli import main
from mgehl.output.table import _films, _gaps, _steps, collect, with_bands

RESULT = {"central_film_nm": 12.14361, "minimum_film_nm": 5.05}


def test_a_file_has_all_digits_and_the_bands_beside_them():
    row = _films(RESULT | {"error": {"central_nm": 0.37, "minimum_nm": None}})
    assert row == {
        "central nm": "12.1436",
        "minimum nm": "5.0500",
        "central ± nm": "0.37",
        "minimum ± nm": "",
    }


def test_runs_of_before_have_none():
    assert _films(RESULT)["central ± nm"] == ""


def test_a_table_that_is_shown_has_no_more_digits_than_films_have():
    rows = [
        _films(RESULT | {"error": {"central_nm": 0.37, "minimum_nm": 0.2}}) | {"run": "a"},
        _films(RESULT),
    ]
    assert with_bands(rows) == [
        {"central nm": "12.1 ± 0.4", "minimum nm": "5.0 ± 0.2", "run": "a"},
        {"central nm": "12.1436", "minimum nm": "5.0500"},
    ]


def test_steps_of_several_solves_are_those_within_each():
    """The time from one solve to the next is that of other grids, too."""
    history = [(0, 1.0), (1, 2.0), (2, 3.0), (0, 9.0), (1, 9.5)]
    rows = [{"step": str(step), "seconds": str(seconds)} for step, seconds in history]
    taken = [float(after["seconds"]) - float(before["seconds"]) for before, after in _steps(rows)]
    assert taken == [1.0, 1.0, 0.5]


def test_time_a_node_is_of_all_nodes_and_no_more(tmp_path):
    """A line has as many as it says, a plane that squared."""
    for kind, nodes in (("line", 257), ("point", 65)):
        settings = [
            f"contact.kind={kind}",
            f"grid.nodes={nodes}",
            "motion.speed=1 m/s",
            "solver.start=film",
        ]
        command = ["run", *(word for each in settings for word in ("--set", each)), "--quiet", "--no-error"]
        assert main([*command, "--out", str(tmp_path / kind)]) == 0
    rows = collect([tmp_path / "line", tmp_path / "point"])
    for row, nodes in zip(rows, (257, 65**2), strict=True):
        history = _read(tmp_path / row["run"] / "history.csv")
        finest = [each for each in history if each["grid"] == row["nodes"]]
        seconds = [float(b["seconds"]) - float(a["seconds"]) for a, b in _steps(finest)]
        mean = 1e6 * sum(seconds) / len(seconds) / nodes
        assert float(row["us a step and node"]) == pytest.approx(mean, abs=1e-3)
        assert int(row["Newton steps on finest"]) == len(seconds)


def _read(path):
    with path.open() as file:
        return list(csv.DictReader(file))


ROUGH = {"mean_gap_nm": 13.741264, "loaded_gap_nm": 2.911206}


def test_mean_gaps_of_rough_bodies_have_bands_too():
    row = _gaps({"mixed": ROUGH | {"error": {"mean_nm": 0.0636, "loaded_nm": 0.0488}}})
    assert (row["mean gap nm"], row["loaded gap ± nm"]) == ("13.7413", "0.0488")
    assert with_bands([row]) == [{"mean gap nm": "13.74 ± 0.07", "loaded gap nm": "2.91 ± 0.05"}]


def test_without_bands_or_rough_bodies_they_are_bare_or_empty():
    assert with_bands([_gaps({"mixed": ROUGH | {"error": None}})])[0]["mean gap nm"] == "13.7413"
    assert set(_gaps({"mixed": None}).values()) == {""}
