"""Arrays that several ranks see; that they do is tested in tests/parallel."""

import errno
import os

import pytest
from mpi4py import MPI

from mgehl.grid import shared_memory
from mgehl.grid.shared_memory import shared_array

pytestmark = pytest.mark.skipif(not shared_memory.DIRECTORY.is_dir(), reason="files are no memory here")


@pytest.fixture
def files(tmp_path, monkeypatch):
    """Function: the files that are left where shared arrays had theirs."""
    monkeypatch.setattr(shared_memory, "DIRECTORY", tmp_path)
    return lambda: list(tmp_path.iterdir())


def test_no_file_is_left(files):
    array = shared_array(MPI.COMM_SELF, (3, 5), float)
    assert array is not None and files() == []


def test_without_room_there_is_none(files, monkeypatch):
    def full(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "posix_fallocate", full)
    assert shared_array(MPI.COMM_SELF, (3, 5), float) is None and files() == []
