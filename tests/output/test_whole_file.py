"""A file is written whole or not at all."""

import pytest

from mgehl.errors import OutputError
from mgehl.output.whole_file import write_whole


def test_a_file_is_replaced_and_nothing_else_stays(tmp_path):
    path = tmp_path / "file"
    path.write_text("old")
    write_whole(path, "new")
    assert path.read_text() == "new" and list(tmp_path.iterdir()) == [path]


def test_what_was_there_stays_where_writing_fails(tmp_path, monkeypatch):
    path = tmp_path / "file"
    path.write_text("old")

    def full(self, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.replace", full)
    with pytest.raises(OutputError, match="file: cannot be written: No space left on device"):
        write_whole(path, "new")
    assert path.read_text() == "old" and list(tmp_path.iterdir()) == [path]


def test_a_directory_that_is_not_there_is_one_line(tmp_path):
    with pytest.raises(OutputError, match="missing/file: cannot be written"):
        write_whole(tmp_path / "missing" / "file", "new")
