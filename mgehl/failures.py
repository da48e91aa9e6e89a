"""Every way in which a command may fail: its one line, and its exit status."""

import os
import signal
import sys
import traceback

from mgehl.commands import NOT_CONVERGED, USAGE
from mgehl.errors import Stopped, UserError, one_line

TRACEBACK = "MGEHL_TRACEBACK"
"""Environment variable that has the traceback of an internal error printed, for who is to mend it."""

ENVIRONMENT = 'put the environment on with: eval "$(make -s env)", in the directory of mgehl\'s Makefile'

OUT_OF_MEMORY = "out of memory: fewer nodes, or more ranks on more machines, take less (see mgehl check)"


def told(error):
    """(Line or None, exit status) of whatever a command raised."""
    if isinstance(error, Stopped):
        return str(error), error.status
    if isinstance(error, KeyboardInterrupt):
        return "stopped by Ctrl-C", 128 + signal.SIGINT
    if isinstance(error, BrokenPipeError):  # a reader that has read enough, as in "| head"
        return None, 128 + signal.SIGPIPE
    if isinstance(error, UserError):
        return str(error), USAGE
    if isinstance(error, MemoryError):
        return OUT_OF_MEMORY, NOT_CONVERGED
    if isinstance(error, ImportError):
        return f"{one_line(error)}: {ENVIRONMENT}", USAGE
    if isinstance(error, OSError):
        return _of_system(error), USAGE
    if type(error).__module__.startswith("petsc4py"):
        return _of_petsc(error), NOT_CONVERGED
    return _internal(error), NOT_CONVERGED


def _of_system(error):
    """An error of a file, of the disk, or of the directory that mgehl is started in."""
    try:
        os.getcwd()
    except OSError:
        return "the working directory is gone: go to another one"
    said = error.strerror or one_line(error)
    return f"{os.fsdecode(error.filename)}: {said}" if isinstance(error.filename, str | bytes) else said


def _of_petsc(error):
    """Mostly an option that this matrix-free solver cannot serve, such as -mgehl_pc_type lu."""
    if getattr(error, "ierr", None) == 55:
        return OUT_OF_MEMORY
    return f"PETSc: {one_line(error, 200)}"


def _internal(error):
    """A mistake of mgehl's own."""
    if os.environ.get(TRACEBACK):
        traceback.print_exception(error, file=sys.stderr)
    frames = traceback.extract_tb(error.__traceback__)
    where = f" ({os.path.basename(frames[-1].filename)}, line {frames[-1].lineno})" if frames else ""
    return (
        f"an error of mgehl's own: {type(error).__name__}: {one_line(error)}{where}; "
        f"{TRACEBACK}=1 in the environment shows where, please report it"
    )
