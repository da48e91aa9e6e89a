import pytest
from full_disk import files_of_at_most
from made_solution import make_solution

from mgehl.errors import OutputError
from mgehl.output.files import write_fields
from mgehl.output.whole_file import whole_file, write_whole


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "fields.h5"
    path.write_text("old")
    return path


def names(path):
    return sorted(each.name for each in path.parent.iterdir())


def test_an_exception_leaves_the_old_one(path):
    with pytest.raises(ArithmeticError), whole_file(path) as part:
        part.write_text("half")
        raise ArithmeticError
    with pytest.raises(FileNotFoundError), whole_file(path):
        pass
    assert path.read_text() == "old" and names(path) == ["fields.h5"]


def test_what_cannot_be_written_is_one_line(path, monkeypatch):
    with pytest.raises(OutputError, match="missing/file: cannot be written"):
        write_whole(path.parent / "missing" / "file", "new")

    def full(self, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.replace", full)
    with pytest.raises(OutputError, match="fields.h5: cannot be written: No space left on device"):
        write_whole(path, "new")
    assert path.read_text() == "old" and names(path) == ["fields.h5"]


def test_the_fields_of_a_run_do_not_crash_on_a_full_disk(tmp_path):
    with files_of_at_most(1000), pytest.raises(OSError):
        with whole_file(tmp_path / "fields.h5") as part:
            write_fields(part, make_solution("point"), {})
    assert not list(tmp_path.iterdir())
