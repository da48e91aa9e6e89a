"""The command line.

    mpiexec -n 2 python -m mgehl run [CONFIG] [--set key=value ...] [--out DIR] [PETSc options]
    python -m mgehl keys

argparse takes what it knows; single-dash options go to PETSc. Those of the run's own solvers
carry the prefix mgehl_ (-mgehl_ksp_monitor, -mgehl_snes_view), global ones none (-log_view).
"""

import argparse
import sys
import traceback
from dataclasses import fields
from pathlib import Path

from mgehl.config import SECTIONS, ConfigError, default_config, load_config

CONVERGED, NOT_CONVERGED, USAGE = 0, 1, 2
"""Exit statuses."""


def main(arguments=None):
    """Run the command line; return the exit status."""
    parser = _parser()
    options, rest = parser.parse_known_args(arguments)
    if options.command == "keys":
        print(describe_keys())
        return CONVERGED
    petsc = _petsc_options(parser, rest)
    import petsc4py  # after the arguments are known to be good: it starts MPI

    petsc4py.init([sys.argv[0], *petsc, *(["-options_left"] if petsc else [])])
    from mpi4py import MPI

    return _run(options, MPI.COMM_WORLD)


def _parser():
    parser = argparse.ArgumentParser(
        prog="mgehl", description="Multigrid for mixed and boundary lubrication of loaded contacts."
    )
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    run = commands.add_parser(
        "run",
        help="solve one contact",
        allow_abbrev=False,
        description="Solve one contact and write its directory.",
        epilog="example: mpiexec -n 2 python -m mgehl run --set grid.nodes=513 --set motion.speed='1 m/s'"
        " --set solver.start=film -mgehl_ksp_monitor",
    )
    run.add_argument("config", nargs="?", metavar="CONFIG", help="TOML file (default: the point contact)")
    run.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="settings",
                     help="set a key, such as grid.nodes=513; may be repeated")  # fmt: skip
    run.add_argument("--out", metavar="DIR", help="directory of the results (default: runs/NAME)")
    run.add_argument("--force", action="store_true", help="write into a directory that exists")
    run.add_argument("--quiet", action="store_true", help="print nothing but errors")
    commands.add_parser("keys", help="list every configuration key")
    return parser


def _petsc_options(parser, rest):
    """Single-dash options and their values; anything else is an error."""
    for word in rest:
        if word.startswith("--"):
            parser.error(f"unknown option {word}; PETSc options take one dash")
    if rest and not rest[0].startswith("-"):
        parser.error(f"unexpected argument {rest[0]}")
    return rest


def _run(options, comm):
    """Solve on all ranks; errors of the user's making end in one line and status 2."""
    from mgehl.output.files import OutputError, prepare_directory

    try:
        config = load_config(options.config, options.settings)
        name = Path(options.config or default_config()).stem
        directory = Path(options.out or Path("runs") / name)
        _on_first_rank(comm, prepare_directory, directory, options.force)
        from mgehl.run import run

        result = run(config, directory, comm, speak=not options.quiet)
        return CONVERGED if result.converged else NOT_CONVERGED
    except (ConfigError, OutputError) as error:
        if comm.rank == 0:
            print(f"mgehl: {error}", file=sys.stderr)
        return USAGE
    except Exception:
        # One rank's failure must not leave the others waiting.
        print(f"mgehl: rank {comm.rank} failed", file=sys.stderr)
        traceback.print_exc()
        sys.stderr.flush()
        comm.Abort(1)


def _on_first_rank(comm, function, *arguments):
    """Call on rank 0; every rank raises what it raised."""
    error = None
    if comm.rank == 0:
        try:
            function(*arguments)
        except Exception as caught:
            error = caught
    error = comm.bcast(error)
    if error is not None:
        raise error


def describe_keys():
    """Every configuration key with its default, unit and meaning, a line each."""
    lines = []
    for name, section in SECTIONS.items():
        for key in fields(section):
            rules = key.metadata
            choices = f" ({', '.join(rules['choices'])})" if rules["choices"] else ""
            unit = f" {rules['unit']}" if rules["unit"] else ""
            default = "unset" if key.default is None else f"{key.default}{unit}"
            lines.append(f"{name + '.' + key.name:32} {rules['help']}{choices} [{default}]")
    return "\n".join(lines)
