import shutil

import pytest
from places import names_in

from mgehl.cli import main
from mgehl.output.study_directory import StudyRecord, write_record
from mgehl.studies.catalogue import WHAT

RUN = ["run", "--set", "grid.nodes=65", "--set", "solver.start=contact", "--quiet", "--out"]


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    directory = tmp_path_factory.mktemp("report") / "dry"
    assert main([*RUN, str(directory)]) == 0
    return directory


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    monkeypatch.setattr("mgehl.output.report.run_report.pictures", lambda solution: {})


@pytest.fixture
def here(finished, empty_directory):
    shutil.copytree(finished, empty_directory / "dry")
    return empty_directory


def test_beside_the_results(here, capsys):
    before = names_in(here / "dry")
    (here / "dry" / "report.html").write_text("old")
    assert main(["report", "dry"]) == 0
    assert names_in(here / "dry") == before | {"report.html"}
    assert capsys.readouterr().out == "report dry/report.html\n"
    html = (here / "dry" / "report.html").read_text(encoding="utf-8")
    assert html.startswith("<!DOCTYPE html>") and "Run dry" in html and "Converged" in html


def test_another_file_is_replaced_only_with_force(here, refused):
    page = here / "page.html"
    page.write_text("mine")
    assert "page.html exists: add --force" in refused("report", "dry", "--out", "page.html")
    assert page.read_text() == "mine"
    assert main(["report", "dry", "--out", "page.html", "--force"]) == 0
    assert page.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    assert "report.html" not in names_in(here / "dry")


def test_somebodys_tables_are_no_study(here, refused):
    (here / "race.csv").write_text("x [um];y [um];z [nm]\n0,0;0,0;-87,6\n")
    assert ".: is no run directory: it has no fields.h5" in refused("report", ".")


def test_a_study(here):
    (here / "mine").mkdir()
    (here / "mine" / "films.csv").write_text("couette,central nm\nS2B-vi,393.0\n")
    write_record(here / "mine", StudyRecord("schemes", (65,), 1, {"petsc": "3.18.5"}))
    assert main(["report", "mine"]) == 0
    html = (here / "mine" / "report.html").read_text(encoding="utf-8")
    assert "<h1>Study schemes</h1>" in html and WHAT["schemes"] in html
    assert "S2B-vi" in html and "3.18.5" in html
