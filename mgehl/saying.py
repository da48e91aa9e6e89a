"""Words for whoever runs mgehl. That nobody listens is no reason to end."""

import os
import sys
from contextlib import suppress

from mgehl.errors import printable


def say(*words, sep=" "):
    """Print to standard output, at once; into nothing where it is closed, or its device full."""
    try:
        print(*words, sep=sep, flush=True)
    except (OSError, ValueError):
        silence(sys.stdout)


def complain(words):
    """Print a line of mgehl's to standard error."""
    try:
        print(f"mgehl: {printable(words)}", file=sys.stderr, flush=True)
    except (OSError, ValueError):
        silence(sys.stderr)


def silence(stream):
    """Let a stream, and what it still holds, end in nothing from now on."""
    with suppress(OSError, ValueError, AttributeError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)
        stream.flush()
