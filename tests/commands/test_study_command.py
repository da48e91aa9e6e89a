"""Directories of studies: one study each, whole or unfinished, and never read when they are not whole."""

import json

import pytest

from mgehl.cli import main
from mgehl.output.directory import check_result
from mgehl.studies import inlet

INLET = ["study", "inlet", "--nodes", "129", "--quiet", "--out"]


@pytest.fixture(autouse=True)
def empty_directory(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def study(tmp_path, capsys):
    """A study that has finished."""
    assert main([*INLET, "here"]) == 0
    assert capsys.readouterr() == ("", "")
    return tmp_path / "here"


def refused(capsys, *words):
    assert main(list(words)) == 2
    (line,) = capsys.readouterr().err.splitlines()
    return line


def test_its_files_are_known(study):
    assert set(check_result(study, "study").files) == {"inlet.csv", "inlet.md", "inlet.png", "study.json"}
    assert {path.name for path in study.iterdir()} - {"points"} == {*check_result(study, "study").files,
                                                                      "manifest.json"}  # fmt: skip


def test_a_table_that_was_edited_is_not_reported(study, capsys):
    (study / "inlet.csv").write_text((study / "inlet.csv").read_text().replace("1", "2"))
    assert "inlet.csv: is damaged, was edited" in refused(capsys, "report", "here")


def test_it_goes_on_in_its_own_directory_alone(study, capsys):
    assert main([*INLET, "here", "--resume"]) == 0
    line = refused(capsys, "study", "line", "--out", "here", "--resume")
    assert "here is of study inlet, not of study line" in line
    assert main(["run", "--set", "grid.nodes=65", "--out", "here", "--force"]) == 2
    assert "is the directory of a study" in capsys.readouterr().err


def test_one_that_was_stopped_keeps_the_result_before(study, capsys, monkeypatch):
    """Tables are put together beside those that are there."""
    before = check_result(study, "study")

    def broken(self, name, rows):
        self.directory.joinpath("half.csv").write_text("a,b\n")
        raise KeyboardInterrupt

    with monkeypatch.context() as change:
        change.setattr("mgehl.studies.study.Study.write_table", broken)
        assert main([*INLET, "here", "--force"]) == 130
    assert check_result(study, "study") == before
    assert main([*INLET, "here", "--resume"]) == 0
    assert check_result(study, "study").identity != before.identity and not (study / "half.csv").exists()


def test_a_point_that_does_not_converge_and_need_not_is_no_failure(capsys, monkeypatch):
    monkeypatch.setitem(inlet.BASE, "solver", {"max_steps": 1})
    assert main(["study", "inlet", "--nodes", "129", "--out", "here"]) == 0
    out = capsys.readouterr().out
    assert "NOT CONVERGED" not in out and "no solution, which is an answer here" in out


def test_points_hold_no_program(study):
    for path in (study / "points").iterdir():
        assert path.read_bytes().startswith(b"PK") and b"pickle" not in path.read_bytes()
    assert json.loads((study / "study.json").read_text())["name"] == "inlet"
