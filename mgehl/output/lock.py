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

NAME = ".mgehl-lock"

PATIENCE = 3.0
"""Seconds that a writer waits for another: a rank whose job was killed takes a moment to end."""

_OWNER = "mgehl process {} on {}\n"

_WITHOUT_LOCKS = (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP, errno.EINVAL)
"""Errors of file systems without locks: there the manifest alone tells what belongs together."""


@contextmanager
def locked(comm, directory):
    """Hold a directory that exists for writing, by rank 0 (collective).

    Raises OutputError, on all ranks, where another process holds it or nothing can be written there.
    """
    lock = on_first_rank(comm, lambda: [_Lock(directory)])
    try:
        yield
    finally:
        if lock:
            lock[0].release()


class _Lock:
    """An open file with an exclusive flock: the kernel lets go of it with the process."""

    def __init__(self, directory):
        self._path = Path(directory) / NAME
        try:
            self._wait()
            os.ftruncate(self._file, 0)
            os.write(self._file, _OWNER.format(os.getpid(), socket.gethostname()).encode())
        except BlockingIOError:
            raise OutputError(self._held()) from None
        except OSError as error:
            raise OutputError(f"{directory}: cannot be written: {error.strerror or error}") from None

    def release(self):
        """Let go of it; the file goes first, so that nobody waits for one that is gone."""
        with suppress(OSError):
            self._path.unlink()
        with suppress(OSError):
            os.close(self._file)

    def _wait(self):
        """Take it, now or in a while. Raises BlockingIOError where another keeps it."""
        deadline = time.monotonic() + PATIENCE
        while True:
            try:
                if self._take():
                    return
            except BlockingIOError:
                if time.monotonic() > deadline:
                    raise
            time.sleep(0.05)

    def _take(self):
        """Lock the file; whether it is still the one of that name."""
        self._file = os.open(self._path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o644)
        try:
            _flock(self._file)
            with suppress(FileNotFoundError):
                if os.path.samestat(os.fstat(self._file), os.stat(self._path)):
                    return True
        except OSError:
            os.close(self._file)
            raise
        os.close(self._file)
        return False

    def _held(self):
        owner = ""
        with suppress(OSError, ValueError):
            owner = self._path.read_text(encoding="utf-8").strip()[:200]
        who = owner or "another mgehl process"
        return f"{self._path.parent}: is being written by {who}: wait for it, or choose another with --out"


def _flock(file):
    """Lock, or do without where the file system knows no locks."""
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise
    except OSError as error:
        if error.errno not in _WITHOUT_LOCKS:
            raise
