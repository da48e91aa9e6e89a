"""mgehl info: print versions, libraries, threads and the machine

Print what a run would run on, and which configuration it would read.

example: mgehl info --json
"""

import json

from mgehl.commands import add_configuration
from mgehl.config import load_config
from mgehl.config_file import chosen_config
from mgehl.saying import columns, folded

LONG = ("configured",)
"""Keys that only --json prints: PETSc's configure options fill a screen."""

VALUE = 25
"""Where the values begin."""


def add(parser):
    add_configuration(parser)
    parser.add_argument("--json", action="store_true", help="print as JSON")


def execute(options, comm):
    """Print it on rank 0."""
    from mgehl.output.surroundings import surroundings

    found = {"configuration": _configuration(options.config)} | surroundings(comm)
    if comm.rank == 0:
        print(json.dumps(found, indent=2) if options.json else "\n".join(_lines(found)))


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
    """The name of each section, under it a line for each value; a path is not broken."""
    for name, section in sections.items():
        yield name
        for key, value in section.items():
            if key not in LONG:
                words = key if key.isupper() else key.replace("_", " ")
                yield folded(f"  {words:{VALUE - 2}}{_text(value)}", VALUE * " ", columns())


def _text(value):
    if isinstance(value, bool):
        return "yes" if value else "no"
    if value is None or value == "":
        return "none"
    return f"{value:.1f}" if isinstance(value, float) else str(value)
