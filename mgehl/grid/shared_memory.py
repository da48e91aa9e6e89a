"""Arrays that all ranks of one machine see: nothing has to be sent between them."""

import mmap
import os
import tempfile
from pathlib import Path

import numpy as np
from mpi4py import MPI

DIRECTORY = Path("/dev/shm")
"""Where files are memory; only Linux has it."""


def shared_array(comm, shape, dtype):
    """Zeros of this `shape` that all ranks of `comm` see, an equal part of them near each; collective.

    None where that cannot be: ranks on several machines, or too little room. The room is taken at once, so
    that a rank cannot die of its lack later, and no name of it is left in the file system.
    """
    bounds = np.linspace(0, np.prod(shape) * np.dtype(dtype).itemsize, comm.size + 1).astype(int)
    path = comm.bcast(_new_file(int(bounds[-1])) if comm.rank == 0 else None)
    memory = _mapped(path, *bounds[[comm.rank, comm.rank + 1]].tolist()) if path else None
    everywhere = comm.allreduce(memory is not None, MPI.LAND)
    if path and comm.rank == 0:
        os.unlink(path)
    return np.frombuffer(memory, dtype).reshape(shape) if everywhere else None


def _new_file(size):
    """Path of a file of so many bytes, which take no room yet; None if there can be none."""
    try:
        descriptor, path = tempfile.mkstemp(prefix="mgehl-", dir=DIRECTORY)
    except OSError:
        return None
    try:
        os.truncate(descriptor, size)
    except OSError:
        os.unlink(path)
        return None
    finally:
        os.close(descriptor)
    return path


def _mapped(path, first, end):
    """The whole file in memory, room taken for these bytes of it; None if there is none."""
    try:
        with open(path, "r+b") as file:
            os.posix_fallocate(file.fileno(), first, max(end - first, 1))
            return mmap.mmap(file.fileno(), 0)
    except OSError:
        return None
