"""Files that are there whole, or not at all."""

import os
from contextlib import contextmanager
from pathlib import Path

from mgehl.errors import OutputError


@contextmanager
def whole_file(path):
    """A path to write to; what is there becomes `path` at the end, flushed to the disk before.

    Whatever ends the block, or the process, in between leaves the file of that name as it was.
    """
    path = Path(path)
    # The suffix stays the last word: writers go by it.
    part = path.with_name(f".part-{path.name}")
    try:
        yield part
        with part.open("rb+") as file:
            os.fsync(file.fileno())
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


def write_whole(path, text):
    """Write `text` as a whole file. Raises OutputError."""
    try:
        with whole_file(path) as part:
            part.write_text(text, encoding="utf-8")
    except OSError as error:
        raise OutputError(f"{path}: cannot be written: {error.strerror or error}") from None
