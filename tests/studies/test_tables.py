"""Small studies by the command line, and what their tables say."""

import csv

import pytest
from mpi4py import MPI

from mgehl.cli import main
from mgehl.config import config_from_tables
from mgehl.discretization.couette import SCHEMES
from mgehl.run import solve
from mgehl.studies.study import PAPER, merged, papers_grid

OTHERS = {"runs", "study.json", "report.html"}
"""What every study's directory has beside tables and figures."""


def read(path):
    with path.open() as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """Function that runs a study and returns its directory."""

    def run(name, nodes):
        directory = tmp_path_factory.mktemp("study") / name
        assert main(["study", name, "--nodes", nodes, "--quiet", "--out", str(directory)]) == 0
        return directory

    return run


class TestWedge:
    @pytest.fixture(scope="class")
    def directory(self, study):
        return study("wedge", "65,129")

    def test_cases(self, directory):
        rows = {row["case"]: row for row in read(directory / "cases.csv")}
        pillars = [f"{shape} pillar" for shape in ("square", "cylindrical")]
        variants = ("", ", untreated", ", turned", ", turned, untreated")
        expected = {pillar + variant for pillar in pillars for variant in variants}
        expected |= {"blocked exit", "no blockage"}
        assert rows.keys() == expected
        for name, row in rows.items():
            leak = float(row["flow through closed faces"])
            assert (leak > 10.0) if "untreated" in name else (leak == 0.0)
            assert float(row["residual"]) <= 1e-10 and float(row["flux imbalance"]) <= 1e-12
        load = {name: float(row["load mm"]) for name, row in rows.items()}
        assert load["square pillar, untreated"] > load["square pillar"]
        assert load["square pillar, turned, untreated"] < load["square pillar, turned"]
        assert load["blocked exit"] > load["no blockage"]


def test_schemes(study):
    """One grid: every scheme's film on 65 nodes as a run finds it, no limit."""
    directory = study("schemes", "65")
    assert {path.name for path in directory.iterdir()} == {"films.csv", "films.md", "films.png"} | OTHERS
    rows = read(directory / "films.csv")
    assert [row["couette"] for row in rows] == list(SCHEMES)
    assert all((row["nodes"], row["converged"]) == ("65", "yes") for row in rows)
    central = {row["couette"]: float(row["central nm"]) for row in rows}
    film = {"motion": {"speed": 1.0}, "grid": papers_grid(65)}
    expected = solve(config_from_tables(merged(PAPER, film)), MPI.COMM_SELF).result.central_film_nm
    assert central["1B"] == pytest.approx(expected, abs=1e-4)
    assert central["2B"] < central["1B"]
