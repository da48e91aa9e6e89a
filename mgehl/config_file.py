"""The text of a configuration: of a file, or out of a pipe."""

import os
import select
import stat
from pathlib import Path

PATIENCE = 30.0
"""Seconds without a word after which a pipe is given up."""

LARGEST_FILE = 10**6
"""Bytes of a configuration."""


def text_of(path):
    """The text of a file in UTF-8, as TOML demands, or what comes out of a pipe such as <(...).

    The null device is the empty configuration.
    """
    kind = path.stat().st_mode
    if not (stat.S_ISREG(kind) or stat.S_ISFIFO(kind) or path == Path(os.devnull)):
        raise OSError("is no file")
    content = _out_of_pipe(path) if stat.S_ISFIFO(kind) else _beginning(path)
    if len(content) > LARGEST_FILE:
        raise OSError(f"has more than {LARGEST_FILE} bytes")
    return content.decode()


def _beginning(path):
    with path.open("rb") as file:
        return file.read(LARGEST_FILE + 1)


def _out_of_pipe(path):
    """What comes out of a pipe until its writer ends, or says nothing for too long."""
    content, number = b"", os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    try:
        while len(content) <= LARGEST_FILE:
            if not select.select([number], [], [], PATIENCE)[0]:
                raise OSError(f"is a pipe into which nobody writes, for {PATIENCE:g} s")
            part = os.read(number, LARGEST_FILE)
            if not part:
                break
            content += part
        return content
    finally:
        os.close(number)
