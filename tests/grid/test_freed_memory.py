"""Memory that is freed is given back, where memory is short."""

import errno
import os
import platform
import sys

import pytest
from mpi4py import MPI
from processes import ended

from mgehl.grid import shared_memory
from mgehl.grid.shared_memory import shared_array

FREE = """
import numpy as np
from petsc4py import PETSc
from mgehl.grid.freed_memory import give_back_large_arrays

def resident():
    return int(open("/proc/self/statm").read().split()[1]) * 4096 / 2**20

give_back_large_arrays()
before = resident()
array = np.ones(2**23)
held = resident() - before
del array
print(held, resident() - before)
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="no glibc")
def test_a_freed_array_is_given_back():
    """PETSc's libraries may have told the C library to keep it."""
    held, left = map(float, ended([sys.executable, "-c", FREE]).stdout.split())
    assert held > 60.0 and left < 4.0


pytestmark = pytest.mark.skipif(not shared_memory.DIRECTORY.is_dir(), reason="files are no memory here")


@pytest.fixture
def files(tmp_path, monkeypatch):
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
