"""Words for whoever runs mgehl. That nobody listens is no reason to end."""

import sys
from contextlib import suppress


def say(*words, sep=" "):
    """Print to standard output, at once; into nothing where it is closed, or its device full."""
    with suppress(OSError, ValueError):
        print(*words, sep=sep, flush=True)


def complain(words):
    """Print a line of mgehl's to standard error."""
    with suppress(OSError, ValueError):
        print(f"mgehl: {words}", file=sys.stderr, flush=True)
