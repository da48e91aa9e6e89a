"""Options of PETSc that would end the program without a word of ours: refused before PETSc reads them."""

import os
import re
import sys
from pathlib import Path

from mgehl.errors import OptionError

QUIET = "-no_signal_handler"
"""PETSc takes over the signals otherwise, and ends a program whose reader has read enough."""

LARGEST_FILE = 10**6
"""Bytes of a file of options."""

_GRIDS = re.compile(r"-mgehl_(fluid_)?pc_(mg_levels|type)")
_FIRST_WORDS = ("-", "#", "!", "alias")


def leave_signals_alone():
    """Have PETSc, which wakes later, leave the signals to Python."""
    options = os.environ.get("PETSC_OPTIONS", "")
    if "petsc4py.PETSc" not in sys.modules and QUIET not in options.split():
        os.environ["PETSC_OPTIONS"] = f"{QUIET} {options}".strip()


def check_options(words):
    """Raise OptionError for words that PETSc, or this solver, ends on."""
    for position, word in enumerate(words):
        value = words[position + 1] if position + 1 < len(words) else ""
        if word == "-fp_trap":
            raise OptionError("-fp_trap: what diverges here has no numbers for a while, and says so itself")
        if word == "-options_file":
            _check_file(value)
        if (match := _GRIDS.fullmatch(word)) and (match[2] == "mg_levels" or value == "mg"):
            raise OptionError(
                f"{word} {value}: the grids are those of grid.nodes, PETSc is given no others"
            )


def _check_file(name):
    try:
        if not Path(name).is_file():
            raise OptionError(f"-options_file {name}: is no file")
        with Path(name).open("rb") as file:
            text = file.read(LARGEST_FILE).decode(errors="replace")
    except (OSError, ValueError) as error:
        raise OptionError(f"-options_file {name}: cannot be read: {error}") from None
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip() and not line.strip().lower().startswith(_FIRST_WORDS):
            raise OptionError(f"-options_file {name}: line {number} is no option: {line.strip()[:60]}")
