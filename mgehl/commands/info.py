"""mgehl info: what runs here, for a report of a bug or a paper."""

import json
from dataclasses import asdict

from mgehl.commands import CONVERGED, add_configuration
from mgehl.config import chosen_config, load_config
from mgehl.saying import columns, folded

PARALLEL = True
"""MPI tells how many ranks there are."""

LONG = ("configured",)
"""Keys that only --json prints: PETSc's configure options fill a screen."""

VALUE = 37
"""Where the values begin."""


def add(commands):
    """Add the parser."""
    parser = commands.add_parser(
        "info",
        help="print versions, libraries, threads and the machine",
        allow_abbrev=False,
        description="Print what a run would run on, and which configuration it would read.",
        epilog="example: mgehl info --json",
    )
    add_configuration(parser)
    parser.add_argument("--json", action="store_true", help="print as JSON")
    return parser


def execute(options, comm):
    """Print it on rank 0."""
    from mgehl.output.surroundings import surroundings

    found = {"configuration": _configuration(options.config)} | asdict(surroundings(comm))
    if comm.rank == 0:
        print(json.dumps(found, indent=2) if options.json else "\n".join(_lines(found)))
    return CONVERGED


def _configuration(path):
    """Where the configuration of a run with these words would come from."""
    file = chosen_config(path)
    config = load_config(file)
    return {
        "file": str(file.resolve()),
        "chosen": "on the command line" if path else "by default",
        "kind": config.contact.kind,
        "nodes": config.grid.nodes,
    }


def _lines(sections):
    """A line for each value, aligned; a section's name stands before its first."""
    for name, section in sections.items():
        for position, (key, value) in enumerate(section.items()):
            words = key if key.isupper() else key.replace("_", " ")
            if key not in LONG:
                yield from _broken(
                    f"{name if position == 0 else '':14} {words:21}", _text(value), columns()
                )


def _broken(key, text, width):
    """A value beside its key, broken at spaces; a path too long for that, which has none, below its key."""
    line = f"{key} {text}"
    if width and len(line) > width and " " not in text:
        yield key.rstrip()
        yield text.rjust(width)
    else:
        yield folded(line, VALUE * " ", width)


def _text(value):
    if isinstance(value, bool):
        return "yes" if value else "no"
    if value is None or value == "":
        return "none"
    return f"{value:.1f}" if isinstance(value, float) else str(value)
