"""Tables as files and terminals have them; the one of runs, with bands."""

import csv

import pytest

from mgehl.cli import main
from mgehl.output.table import _work, collect, drawn, with_bands

ROWS = [
    {"case": "a film", "nodes": "65", "film nm": "12.1 ± 0.4", "why": ""},
    {"case": "contact", "nodes": "1025", "film nm": "", "why": "sets cycle"},
]


def test_numbers_stand_on_the_right_and_what_has_no_room_follows_below():
    whole, narrow = (drawn(ROWS, list(ROWS[0]), width).splitlines() for width in (80, 32))
    assert [line.split() for line in whole[2:]] == [
        ["a", "film", "65", "12.1", "±", "0.4"], ["contact", "1025", "sets", "cycle"],
    ]  # fmt: skip
    assert whole[2].index("65") + 2 == whole[3].index("1025") + 4 == whole[0].index("nodes") + 5
    assert max(map(len, narrow)) <= 32 and narrow[4] == "" and narrow[5].split() == ["case", "why"]
    assert " ".join(narrow).split()[-3:] == ["contact", "sets", "cycle"]


def test_a_column_wider_than_the_terminal_is_broken_and_nothing_lost():
    text = drawn([{"a": "x", "b": 50 * "y", "c": "z"}], ["a", "b", "c"], 20)
    assert max(map(len, text.splitlines())) <= 20 and text.count("y") == 50 and "z" in text


def test_a_control_character_moves_no_cursor_and_markup_is_words():
    assert "\x1b" not in drawn([{"a": "\x1b[2J"}], ["a"])
    assert "[red]x" in drawn([{"a": "[red]x"}], ["a"])


def test_bands_are_shown_beside_no_more_digits_than_there_are():
    row = {"run": "a", "central nm": "12.1436", "central ± nm": "0.37", "mean gap nm": "13.7413",
           "mean gap ± nm": "0.0636", "minimum nm": "5.05", "minimum ± nm": ""}  # fmt: skip
    assert with_bands([row]) == [
        {"run": "a", "central nm": "12.1 ± 0.4", "mean gap nm": "13.74 ± 0.07", "minimum nm": "5.05"}
    ]


def test_the_time_of_a_step_is_that_within_each_solve():
    history = [(0, 1.0), (1, 2.0), (2, 3.0), (0, 9.0), (1, 9.5)]
    rows = [{"step": str(step), "seconds": str(seconds)} for step, seconds in history]
    assert _work(rows, 1000) == {
        "most GMRES iterations": "0", "Newton steps on finest": "3", "us a step and node": "833.333"
    }  # fmt: skip


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Directories of four small runs, a kind each."""
    directory = tmp_path_factory.mktemp("runs")
    film = ["motion.speed=1 m/s", "solver.start=film", "solver.error=false", "grid.nodes=65"]
    for name, settings in {
        "line": ["contact.kind=line", *film[:3], "grid.nodes=257"],
        "ball": film,
        "dry": ["discretization.contact_model=dry", "grid.nodes=65"],
        "wedge": ["contact.kind=wedge", "motion.speed=1 m/s", "grid.nodes=65"],
    }.items():
        words = [word for each in settings for word in ("--set", each)]
        assert main(["run", *words, "--quiet", "--out", str(directory / name)]) == 0
    return directory


def test_a_row_for_each_run_of_any_kind(runs):
    rows = {row["run"]: row for row in collect(runs / name for name in ("ball", "line", "dry", "wedge"))}
    assert {tuple(row) for row in rows.values()} == {tuple(rows["ball"])}
    assert all(row["converged"] == "yes" for row in rows.values())
    assert float(rows["ball"]["central nm"]) > 100.0 and rows["ball"]["lambda"] == ""
    assert rows["dry"]["central nm"] == "" and float(rows["dry"]["contact/Hertz area"]) == pytest.approx(
        1.0, abs=0.1
    )
    assert float(rows["wedge"]["load N"]) > 0.0 and rows["line"]["load N"] == ""


@pytest.mark.parametrize("name, nodes", [("line", 257), ("ball", 65**2)])
def test_time_a_node_is_of_all_nodes_and_no_more(runs, name, nodes):
    """A line has as many as it says, a plane that squared."""
    (row,) = collect([runs / name])
    with (runs / name / "history.csv").open() as file:
        finest = [float(each["seconds"]) for each in csv.DictReader(file) if each["grid"] == row["nodes"]]
    mean = 1e6 * (finest[-1] - finest[0]) / (len(finest) - 1) / nodes
    assert float(row["us a step and node"]) == pytest.approx(mean, abs=1e-3)
