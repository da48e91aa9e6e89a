import pytest
from places import RUN_FILES, names_in

from mgehl.cli import main

DRY = ["run", "--quiet", "--set", "grid.nodes=65", "--set", "solver.start=contact", "--out", "here"]

pytestmark = pytest.mark.usefixtures("empty_directory")


def test_a_picture_that_cannot_be_drawn_costs_nothing(tmp_path, capsys, monkeypatch):
    def broken(solution):
        raise RuntimeError("Failed to process string with tex because latex could not be found")

    with monkeypatch.context() as change:
        change.setattr("mgehl.output.pictures.figures.run_picture", broken)
        assert main(DRY) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert "picture.png: cannot be drawn: Failed to process string" in line
    assert "mgehl run --resume here draws it again" in line
    here = tmp_path / "here"
    assert names_in(here) == RUN_FILES - {"picture.png"}
    before = (here / "fields.h5").stat().st_mtime_ns
    assert main(["run", "--resume", "here", "--quiet"]) == 0
    assert (here / "picture.png").read_bytes().startswith(b"\x89PNG")
    assert (here / "fields.h5").stat().st_mtime_ns == before


def test_what_was_made_of_the_run_before_is_named(capsys):
    """fields.nc of another speed lay beside the new result without a word."""
    assert main(DRY) == 0
    assert main(["export", "here", "--to", "nc"]) == 0
    assert "before" not in capsys.readouterr().err
    assert main([*DRY, "--force"]) == 0
    assert "here: of the run that was there before are still fields.nc" in capsys.readouterr().err


@pytest.mark.parametrize("begun", [False, True])
def test_a_kill_at_the_very_beginning_is_in_nobodys_way(monkeypatch, begun):
    """What it left is mgehl's: --force replaces it."""

    def kill(*_, **__):
        raise KeyboardInterrupt

    with monkeypatch.context() as change:
        change.setattr("mgehl.run.solve" if begun else "mgehl.output.archive.npy.write_array", kill)
        assert main(DRY) == 130
    assert main(["run", "--resume", "here", "--quiet"]) == (0 if begun else 2)
    assert main([*DRY, "--force"]) == 0
