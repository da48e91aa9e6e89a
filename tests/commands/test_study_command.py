from pathlib import Path

import pytest
from places import names_in
from told import counting

from mgehl.cli import main
from mgehl.output.study_directory import StudyRecord, begin_study, finish_study, read_record
from mgehl.studies import dry

DRY = ["study", "dry", "--nodes", "65", "--quiet", "--out"]


@pytest.fixture(autouse=True)
def small(empty_directory, monkeypatch):
    monkeypatch.setattr(dry, "SURFACES", {"smooth": None})


@pytest.fixture
def study(tmp_path, capsys):
    assert main([*DRY, "here"]) == 0
    assert capsys.readouterr() == ("", "")
    return tmp_path / "here"


def test_a_table_of_somebody_else_is_left_alone(tmp_path, refused):
    (tmp_path / "here").mkdir()
    (tmp_path / "here" / "dry.csv").write_text("mine")
    assert "here/dry.csv: is not this study's" in refused(*DRY, "here", "--force")
    assert (tmp_path / "here" / "dry.csv").read_text() == "mine"


@pytest.mark.parametrize("moved", range(4))
def test_an_end_in_between_is_made_good(tmp_path, moved, monkeypatch):
    """After so many files are removed or moved: those of the next one take their places."""

    def written(version, *names):
        stage = begin_study(tmp_path, StudyRecord("dry", (65,), 1, {"mgehl": version}), False)
        for name in names:
            (stage / name).write_text(version)
        finish_study(tmp_path, stage, False)

    written("0", "a.csv", "b.csv")
    steps = iter(range(moved))
    with monkeypatch.context() as change:
        for name in ("replace", "unlink"):
            change.setattr(f"pathlib.Path.{name}", counting(getattr(Path, name), steps))
        with pytest.raises(KeyboardInterrupt):
            written("1", "b.csv", "c.csv")
    written("1", "b.csv", "c.csv")
    found = {path.name: path.read_text() for path in tmp_path.glob("*.csv")}
    assert found == {"b.csv": "1", "c.csv": "1"} and read_record(tmp_path).versions == {"mgehl": "1"}


def test_by_force_its_runs_are_solved_anew_and_what_is_not_its_own_stays(study):
    (run,) = (study / "runs").iterdir()
    before = (run / "fields.h5").stat().st_mtime_ns
    (run / "notes.txt").write_text("mine")
    (study / "runs" / "mine").mkdir()
    assert main([*DRY, "here", "--force"]) == 0
    assert (run / "fields.h5").stat().st_mtime_ns > before
    assert (run / "notes.txt").read_text() == "mine" and (study / "runs" / "mine").exists()
    assert main(["study", "dry", "--nodes", "129", "--quiet", "--out", "here", "--force"]) == 0
    assert names_in(run) == {"notes.txt"}


def test_it_goes_on_in_its_own_directory_alone(study, refused):
    assert main([*DRY, "here", "--resume"]) == 0
    line = refused("study", "wedge", "--out", "here", "--resume")
    assert "here is of study dry, not of study wedge" in line
    line = refused("run", "--set", "grid.nodes=65", "--out", "here", "--force")
    assert "is the directory of a study" in line
