"""The commands of the command line, a module each.

A module's docstring is its help: a line, what it does, an example. `add(parser)` adds its options, if it
takes any; `execute(options)` returns the exit status, or nothing where all went well. Of several ranks the
first calls it, but those of `PARALLEL`, after PETSc was started, call `execute(options, comm)` all.
"""

from pathlib import Path

from mgehl.errors import UserError

COMMANDS = (
    "run", "sweep", "study", "collect", "plot", "report", "export", "cite",
    "check", "new", "keys", "info", "bench", "completion",
)  # fmt: skip
"""In the order of the help."""

PARALLEL = "run", "sweep", "study", "info", "bench"
"""Those that every rank executes; `info` to be told how many there are."""

CONVERGED, NOT_CONVERGED, USAGE = 0, 1, 2
"""Exit statuses: done; not converged, or failed on the way; a mistake in the input."""


def execute_on(comm, options):
    """The exit status of the command in `options`; what needs one rank is done, and said, by the first."""
    if options.command in PARALLEL:
        return options.module.execute(options, comm)
    from mgehl.output.files import from_first_rank

    return comm.bcast(from_first_rank(comm, options.module.execute, options))


def shown(file):
    """A file's path as it is said: short where it lies in the working directory."""
    here = Path.cwd()
    return str(file.relative_to(here) if file.is_relative_to(here) else file)


def add_configuration(parser):
    """Add the words that name a configuration."""
    words = "TOML file (default: a rough ball, with --set alone the paper's smooth ball)"
    parser.add_argument("config", nargs="?", metavar="CONFIG", help=words)


def add_settings(parser, help="set a key, such as grid.nodes=513; may be repeated"):
    """Add the option that overrides its keys."""
    parser.add_argument(
        "--set", action="append", default=[], metavar="KEY=VALUE", dest="settings", help=help
    )


def add_results(parser, directory):
    """Add where the results of many runs go, and whether they go on and are told."""
    parser.add_argument("--out", metavar="DIR", help=f"directory of the results (default: {directory})")
    parser.add_argument("--resume", action="store_true", help="go on with the points that are finished")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")


def whole_number(option, low, high=10**6):
    """What reads the whole number of an option, in a range. Raises UserError."""

    def read(text):
        if not (text.isascii() and text.isdecimal() and len(text) < 20 and low <= int(text) <= high):
            raise UserError(f"{option} {text}: must be a whole number from {low} to {high}")
        return int(text)

    return read


def several(option, known):
    """What reads the words of an option, A,B, all of which are `known`, each once. Raises
    UserError."""

    def read(text):
        words = [word.strip() for word in text.split(",")]
        for word in words:
            if word not in known:
                raise UserError(f"{option} {word}: known are {', '.join(known)}")
        return list(dict.fromkeys(words))

    return read
