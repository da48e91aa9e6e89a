"""The commands of the command line, a module each.

A module has `add(commands)`, which adds and returns its parser, and `execute`: of the options alone,
or where `PARALLEL` is true of the options and the communicator, on every rank, PETSc being awake.
Both return the exit status.
"""

COMMANDS = (
    "run", "study", "collect", "plot", "report", "export",
    "check", "new", "keys", "info", "bench", "completion",
)  # fmt: skip
"""In the order of the help."""

CONVERGED, NOT_CONVERGED, USAGE = 0, 1, 2
"""Exit statuses: done; not converged, or failed on the way; a mistake in the input."""
