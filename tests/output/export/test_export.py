import pytest
from made_solution import make_solution
from told import refusal

from mgehl.errors import OutputError
from mgehl.output.export.export import WRITERS, export

every_format = pytest.mark.parametrize("name", WRITERS)


@every_format
def test_one_that_exists_stays_without_force(name, tmp_path):
    path = tmp_path / f"mine.{name}"
    path.write_text("mine")
    with pytest.raises(OutputError, match="exists: add --force"):
        export(make_solution("point"), {name: path})
    assert path.read_text() == "mine"
    export(make_solution("point"), {name: path}, force=True)
    assert path.stat().st_size > 1000


def test_all_are_looked_at_before_the_first_is_written(tmp_path):
    (tmp_path / "a.csv").write_text("mine")
    with pytest.raises(OutputError, match="exists"):
        export(make_solution("point"), {"npz": tmp_path / "a.npz", "csv": tmp_path / "a.csv"})
    assert not (tmp_path / "a.npz").exists()


@every_format
@pytest.mark.parametrize("place", ["a file", "a directory"])
def test_a_place_that_cannot_be_written_is_one_line(name, place, tmp_path):
    path = tmp_path / "taken" / f"mine.{name}"
    if place == "a file":
        (tmp_path / "taken").write_text("mine")
    else:
        path.mkdir(parents=True)
    said = refusal(export, make_solution("point"), {name: path}, force=True, error=OutputError)
    assert "cannot be written" in said
    assert len(list(tmp_path.rglob("*"))) == (1 if place == "a file" else 2)
