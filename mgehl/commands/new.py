"""mgehl new: write a commented configuration

Write NAME.toml: every key with its meaning, unit, range and default, the essential ones live.

example: mgehl new bearing --kind wedge
"""

from pathlib import Path

from mgehl.errors import OutputError, UserError, printable
from mgehl.kinds import KINDS


def add(parser):
    parser.add_argument("name", metavar="NAME", help="name of the file, with or without .toml")
    parser.add_argument("--kind", choices=tuple(KINDS), help="kind of contact (default: NAME's, or point)")
    parser.add_argument("--force", action="store_true", help="replace a file that exists")


def execute(options):
    """Write the file."""
    from mgehl.output.template import template
    from mgehl.output.whole_file import write_whole

    path = Path(options.name.removesuffix(".toml") + ".toml")
    if options.name.endswith("/") or path.stem in ("", ".", "..", ".toml"):
        raise UserError(f"{options.name}: is no name of a file")
    if path.exists() and not options.force:
        raise OutputError(f"{path} exists: add --force to replace it, or choose another name")
    kind = options.kind or (path.stem if path.stem in KINDS else "point")
    write_whole(path, template(kind, path))
    name = printable(str(path))
    print(f"{name}: change what differs in your case, then: mpiexec -n 2 python -m mgehl run {name}")
