"""Words for whoever runs mgehl. That nobody listens is no reason to end."""

import os
import sys
import textwrap
from contextlib import suppress

from mgehl.errors import printable

NARROWEST = 20
"""Columns of text that are left beside an indent, on however narrow a terminal."""


def say(*words):
    """Print to standard output, at once; into nothing where it is closed, or its device full."""
    try:
        print(*words, flush=True)
    except (OSError, ValueError):
        silence(sys.stdout)


def mention(words):
    """Print a line of mgehl's to standard output, folded as the terminal is wide."""
    say(folded(f"mgehl: {words}", "    ", columns()))


def complain(words):
    """Print a line of mgehl's to standard error."""
    try:
        print(f"mgehl: {printable(words)}", file=sys.stderr, flush=True)
    except (OSError, ValueError):
        silence(sys.stderr)


def columns():
    """Columns of the terminal that standard output is, or that COLUMNS says; None where there is none."""
    said = os.environ.get("COLUMNS", "")
    if said.isdecimal() and int(said) > 0:
        return int(said)
    try:
        return os.get_terminal_size(sys.stdout.fileno()).columns or None
    except (OSError, ValueError, AttributeError):  # no terminal, or closed
        return None


def folded(line, indent, width):
    """A line broken at spaces, so that none is longer than `width` columns; `indent` begins those after.
    Words that are longer, such as paths, stay whole. Without a width the line stays as it is."""
    if width is None or len(line) <= width or " " not in line[len(indent) :].strip():
        return line
    return textwrap.fill(
        line, max(width, len(indent) + NARROWEST), subsequent_indent=indent, break_long_words=False,
        break_on_hyphens=False, drop_whitespace=True,
    )  # fmt: skip


def silence(stream):
    """Let a stream, and what it still holds, end in nothing from now on."""
    with suppress(OSError, ValueError, AttributeError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)
        stream.flush()
