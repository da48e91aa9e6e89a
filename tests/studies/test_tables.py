import pytest
from contacts import solved
from places import names_in
from told import rows_of

from mgehl.cli import main
from mgehl.discretization.couette import SCHEMES
from mgehl.studies.study import PAPER, papers_grid

OTHERS = {"runs", "study.json", "report.html"}
"""What every study's directory has beside tables and figures."""


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    def run(name, nodes):
        directory = tmp_path_factory.mktemp("study") / name
        assert main(["study", name, "--nodes", nodes, "--quiet", "--out", str(directory)]) == 0
        return directory

    return run


def test_wedge(study):
    rows = {row["case"]: row for row in rows_of(study("wedge", "65") / "cases.csv")}
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
    assert names_in(directory) == {"films.csv", "films.md", "films.png"} | OTHERS
    rows = rows_of(directory / "films.csv")
    assert [row["couette"] for row in rows] == list(SCHEMES)
    assert all((row["nodes"], row["converged"]) == ("65", "yes") for row in rows)
    central = {row["couette"]: float(row["central nm"]) for row in rows}
    film = {"motion": {"speed": 1.0}, "grid": papers_grid(65)}
    expected = solved(PAPER, film).result.central_film_nm
    assert central["1B"] == pytest.approx(expected, abs=1e-4)
    assert central["2B"] < central["1B"]
