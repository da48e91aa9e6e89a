"""Directories of studies: one study each, whole or unfinished, and never read when they are not whole."""

import json

import pytest

from mgehl.cli import main
from mgehl.output.directory import check_result
from mgehl.studies import dry

DRY = ["study", "dry", "--nodes", "65", "--quiet", "--out"]


@pytest.fixture(autouse=True)
def empty_directory(tmp_path, monkeypatch):
    """And a study of a smooth contact alone."""
    monkeypatch.setattr(dry, "SURFACES", {"smooth": None})
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def study(tmp_path, capsys):
    """A study that has finished."""
    assert main([*DRY, "here"]) == 0
    assert capsys.readouterr() == ("", "")
    return tmp_path / "here"


def refused(capsys, *words):
    assert main(list(words)) == 2
    (line,) = capsys.readouterr().err.splitlines()
    return line


def test_its_files_are_known(study):
    assert set(check_result(study, "study").files) == {"dry.csv", "dry.md", "study.json"}
    assert {path.name for path in study.iterdir()} - {"points"} == {*check_result(study, "study").files,
                                                                      "manifest.json"}  # fmt: skip


def test_a_table_that_was_edited_is_not_reported(study, capsys):
    (study / "dry.csv").write_text((study / "dry.csv").read_text().replace("1", "2"))
    assert "dry.csv: is damaged, was edited" in refused(capsys, "report", "here")


def test_it_goes_on_in_its_own_directory_alone(study, capsys):
    assert main([*DRY, "here", "--resume"]) == 0
    line = refused(capsys, "study", "wedge", "--out", "here", "--resume")
    assert "here is of study dry, not of study wedge" in line
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
        assert main([*DRY, "here", "--force"]) == 130
    assert check_result(study, "study") == before
    assert main([*DRY, "here", "--resume"]) == 0
    assert check_result(study, "study").identity != before.identity and not (study / "half.csv").exists()


@pytest.mark.parametrize("name, said", [("onset", "study onset is no longer part of mgehl"), ("x", "x: ")])
def test_a_study_that_is_none_is_one_line(capsys, name, said):
    with pytest.raises(SystemExit, match="2"):
        main(["study", name])
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line and ("runs/README.md" in line or "wedge, grid" in line)


@pytest.mark.parametrize("word, said", [("grid.nodes=65", "--nodes"), ("grid.nods=65", "unknown key"),
                                        ("nodes", "section.key=value")])  # fmt: skip
def test_settings_that_are_none_are_one_line(capsys, word, said):
    assert said in refused(capsys, *DRY, "here", "--set", word)


def test_points_hold_no_program(study):
    for path in (study / "points").iterdir():
        assert path.read_bytes().startswith(b"PK") and b"pickle" not in path.read_bytes()
    assert json.loads((study / "study.json").read_text())["name"] == "dry"
