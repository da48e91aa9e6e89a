"""Files that are there whole, or not at all."""

import os
import signal
import subprocess
import sys

import pytest

from mgehl.errors import OutputError
from mgehl.output.whole_file import whole_file, write_whole


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "fields.h5"
    path.write_text("old")
    return path


def names(path):
    return sorted(each.name for each in path.parent.iterdir())


def test_what_was_written_is_the_file(path):
    with whole_file(path) as part:
        part.write_text("new")
        assert path.read_text() == "old"
    assert path.read_text() == "new" and names(path) == ["fields.h5"]


def test_a_file_that_was_not_there(tmp_path):
    with whole_file(tmp_path / "a.png") as part:
        part.write_bytes(b"new")
    assert (tmp_path / "a.png").read_bytes() == b"new"


def test_an_exception_leaves_the_old_one(path):
    with pytest.raises(ArithmeticError), whole_file(path) as part:
        part.write_text("half")
        raise ArithmeticError
    assert path.read_text() == "old" and names(path) == ["fields.h5"]


def test_writing_nothing_is_an_error_and_leaves_the_old_one(path):
    with pytest.raises(FileNotFoundError), whole_file(path):
        pass
    assert path.read_text() == "old"


def test_writers_find_the_suffix_they_go_by(path):
    with whole_file(path) as part:
        part.write_text("new")
        assert part.suffix == ".h5" and part.parent == path.parent and part != path


def test_a_kill_leaves_the_old_one_and_the_next_writer_clears_up(path):
    text = (
        "import os, signal, sys\n"
        "from mgehl.output.whole_file import whole_file\n"
        "with whole_file(sys.argv[1]) as part:\n"
        "    part.write_text('half')\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    done = subprocess.run([sys.executable, "-c", text, path], env=dict(os.environ))
    assert done.returncode == -signal.SIGKILL
    assert path.read_text() == "old" and len(names(path)) == 2
    with whole_file(path) as part:
        part.write_text("new")
    assert path.read_text() == "new" and names(path) == ["fields.h5"]


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
