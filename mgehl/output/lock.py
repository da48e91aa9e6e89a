"""One writer a directory: a lock that a process keeps as long as it lives, and not longer."""

import errno
import fcntl
import os
import socket
import time
from contextlib import contextmanager, suppress
from pathlib import Path

from mgehl.errors import OutputError
from mgehl.output.files import on_first_rank
from mgehl.output.whole_file import writing

NAME = ".mgehl-lock"

PATIENCE = 3.0
"""Seconds that a writer waits for another: a rank whose job was killed takes a moment to end."""

_WITHOUT_LOCKS = (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP, errno.EINVAL)
"""Errors of file systems without locks: there nobody is kept out."""


@contextmanager
def locked(comm, directory):
    """Hold a directory that exists for writing, by rank 0 (collective). Raises OutputError, on all ranks,
    where another process holds it or nothing can be written there."""
    path = Path(directory) / NAME
    file = on_first_rank(comm, _take, path)
    try:
        yield
    finally:
        if file is not None:
            with suppress(OSError):  # the name goes first: nobody is to wait for a file that is gone
                path.unlink()
            os.close(file)


def _take(path):
    """The open file of that name with an exclusive flock: the kernel lets go of it with the process."""
    deadline = time.monotonic() + PATIENCE
    with writing(path.parent):
        while True:
            file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o644)
            if _is_locked(path, file):
                os.ftruncate(file, 0)
                os.write(file, f"mgehl process {os.getpid()} on {socket.gethostname()}\n".encode())
                return file
            os.close(file)
            if time.monotonic() > deadline:
                raise OutputError(_held(path))
            time.sleep(0.05)


def _is_locked(path, file):
    """Whether it is locked now, as far as the file system knows locks, and has its name still: who let go
    of it has removed it."""
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return os.path.samestat(os.fstat(file), os.stat(path))
    except (BlockingIOError, FileNotFoundError):
        return False
    except OSError as error:
        if error.errno not in _WITHOUT_LOCKS:
            raise
    return True


def _held(path):
    owner = "another mgehl process"
    with suppress(OSError, ValueError):
        owner = path.read_text(encoding="utf-8").strip()[:200] or owner
    return f"{path.parent}: is being written by {owner}: wait for it, or choose another with --out"
