"""Files that are written whole or not at all; and what is never overwritten."""

import errno
import os
import re
import stat
from contextlib import contextmanager, suppress
from pathlib import Path

from mgehl.errors import OutputError

_PART = re.compile(r"\.part-(?P<process>\d+)-(?P<name>.+)", re.DOTALL)


def is_plain(path):
    """True of a file that is no link, no device and no directory."""
    with suppress(OSError):
        return stat.S_ISREG(os.lstat(path).st_mode)
    return False


def is_folder(path):
    """True of a directory that is no link."""
    with suppress(OSError):
        return stat.S_ISDIR(os.lstat(path).st_mode)
    return False


@contextmanager
def writing(path):
    """What cannot be written is an OutputError in one line, which begins with `path`."""
    try:
        yield
    except OSError as error:
        raise OutputError(f"{path}: cannot be written: {error.strerror or error}") from None


@contextmanager
def whole_file(path):
    """A path to write to. At the end that file is flushed to the disk and becomes `path`.

    Whatever ends the block, or the process, in between leaves the file of that name as it was. Raises
    OSError where what is there is no plain file.
    """
    path = Path(path)
    if os.path.lexists(path) and not is_plain(path):
        raise OSError(errno.EEXIST, "a link, a device or a directory is in its place, and is left alone")
    clear_parts(path.parent, path.name)
    # The suffix stays the last word: writers go by it.
    part = path.with_name(f".part-{os.getpid()}-{path.name}")
    try:
        yield part
        with part.open("rb+") as file:
            os.fsync(file.fileno())
        part.replace(path)
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


def write_whole(path, text):
    """Write `text` as a whole file. Names of files in it may be no text: escaped. Raises OutputError."""
    with writing(path), whole_file(path) as part:
        part.write_bytes(text.encode("utf-8", "backslashreplace"))


def remove_plain(paths):
    """Remove those of some paths that are plain files. Raises OSError."""
    for path in filter(is_plain, paths):
        path.unlink()


def clear_parts(folder, name=None):
    """Remove unfinished parts of a file, or of all files of a folder, whose processes have ended."""
    with suppress(OSError):
        for each in Path(folder).iterdir():
            match = _PART.fullmatch(each.name)
            if match and name in (None, match["name"]) and is_plain(each) and _is_over(match["process"]):
                each.unlink()


def _is_over(process):
    """Whether no other process has that number."""
    try:
        os.kill(int(process), 0)
    except (ProcessLookupError, OverflowError):
        return True
    except OSError:
        return False
    return int(process) == os.getpid()
