"""The command line.

    mpiexec -n 2 python -m mgehl run [CONFIG] [--set key=value ...] [--out DIR] [PETSc options]
    mpiexec -n 2 python -m mgehl study NAME [--nodes 129,257] [--out DIR] [PETSc options]
    python -m mgehl collect RUN [RUN ...] [--out FILE.csv]
    python -m mgehl keys

argparse takes the words before the first single-dash option, PETSc that option and all after.
Options of the run's own solvers carry the prefix mgehl_ (-mgehl_ksp_monitor, -mgehl_snes_view;
mgehl_fluid_ for the fluid solved apart), global ones none (-log_view). Unused ones are reported.
"""

import argparse
import sys
import traceback
from dataclasses import fields
from pathlib import Path

from mgehl.config import SECTIONS, ConfigError, check_ranks, default_config, load_config
from mgehl.discretization.fluid import FACE_MEANS

STUDIES = {
    "wedge": "the rigid wedge bearing, Figures 7 to 10, convergence to the exact series",
    "line": "line-contact films against the formulas",
    "inlet": "the line contact from under-resolved to resolved inlets, from both starts",
    "methods": "Newton with multigrid beside the paper's relaxation, interface conditions beside none",
    "transition": "from full film to full contact and back, Figure 14 and Table 1",
    "grid": "full contact and full film on ever finer grids, Figures 11 to 13",
    "onset": "the speeds at which contact appears and full contact is lost, against the grid",
    "bracket": "films by three means of the mobility, which close on the answer with the grid",
    "schemes": "films of the point contact by every differential scheme",
}

DOUBLING = ("wedge", "schemes")
"""Studies whose orders and limits need grids of half the spacing of the one before."""

LARGEST_LISTS = {"line": 1, "methods": 0}
"""Grids that --nodes may name, where not any number."""

_TAKES = {0: "has grids of its own", 1: "takes one grid"}

CONVERGED, NOT_CONVERGED, USAGE = 0, 1, 2
"""Exit statuses."""


def main(arguments=None):
    """Run the command line; return the exit status."""
    own, petsc = split_options(sys.argv[1:] if arguments is None else arguments)
    parser = _parser()
    for word in petsc:
        if word.startswith("--"):
            parser.error(f"{word}: PETSc options take one dash and come last")
    options = parser.parse_args(own)
    if options.command == "keys":
        print(describe_keys())
        return CONVERGED
    if options.command == "collect":
        return _collect(options)
    import petsc4py  # after the arguments are known to be good: it starts MPI

    petsc4py.init([sys.argv[0], *petsc, *(["-options_left"] if petsc else [])])
    from mpi4py import MPI

    return _run(options, MPI.COMM_WORLD)


class _Parser(argparse.ArgumentParser):
    """Says in one line what is wrong."""

    def error(self, message):
        from mpi4py import MPI

        self.exit(
            USAGE, f"mgehl: {message} (see {self.prog} --help)\n" if MPI.COMM_WORLD.rank == 0 else None
        )


def _parser():
    parser = _Parser(
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
    study = commands.add_parser(
        "study",
        help="solve many cases and make tables and pictures of them",
        allow_abbrev=False,
        description="Solve the cases of a study; write its tables (CSV, Markdown) and pictures.",
        epilog="; ".join(f"{name}: {text}" for name, text in STUDIES.items()),
    )
    study.add_argument("study", choices=tuple(STUDIES), metavar="NAME", help=", ".join(STUDIES))
    study.add_argument("--nodes", "--grid", metavar="N,N,...", help="grids instead of the study's own")
    study.add_argument("--direction", choices=("down", "up", "both"), default="both",
                       help="branches that study transition follows")  # fmt: skip
    study.add_argument("--mean", choices=tuple(FACE_MEANS), default="arithmetic",
                       help="mean of the mobility that study transition follows")  # fmt: skip
    study.add_argument("--out", metavar="DIR", help="directory of the results (default: runs/study-NAME)")
    study.add_argument("--force", action="store_true", help="start anew in a directory that exists")
    study.add_argument(
        "--resume", action="store_true", help="go on with the points that are finished there"
    )
    study.add_argument("--quiet", action="store_true", help="print nothing but errors")
    collect = commands.add_parser("collect", help="make one table of several run directories")
    collect.add_argument("runs", nargs="+", metavar="RUN", help="run directory")
    collect.add_argument("--out", metavar="FILE", help="write the whole table as CSV, too")
    collect.add_argument("--columns", metavar="A,B", help="print only these columns")
    commands.add_parser("keys", help="list every configuration key")
    return parser


def split_options(arguments):
    """Split the words of a command line into mgehl's own and PETSc's."""
    for position, word in enumerate(arguments):
        if word.startswith("-") and not word.startswith("--") and word != "-h":
            return arguments[:position], arguments[position:]
    return arguments, []


def _run(options, comm):
    """Run or study on all ranks; errors of the user's making end in one line and status 2."""
    from petsc4py import PETSc

    from mgehl.output.files import OutputError
    from mgehl.solver.newton import OptionError

    try:
        return _run_one(options, comm) if options.command == "run" else _study(options, comm)
    except (ConfigError, OutputError, OptionError) as error:
        if comm.rank == 0:
            print(f"mgehl: {error}", file=sys.stderr)
        return USAGE
    except PETSc.Error as error:
        # Mostly an option that this matrix-free solver cannot serve, such as -mgehl_pc_type lu.
        print(f"mgehl: PETSc: {' '.join(str(error).split())[:200]}", file=sys.stderr, flush=True)
        comm.Abort(1)
    except Exception:
        # One rank's failure must not leave the others waiting.
        print(f"mgehl: rank {comm.rank} failed", file=sys.stderr)
        traceback.print_exc()
        sys.stderr.flush()
        comm.Abort(1)


def _run_one(options, comm):
    from mgehl.output.files import on_first_rank, prepare_directory
    from mgehl.plausibility import check_contact
    from mgehl.solver.from_config import contact_from

    config = load_config(options.config, options.settings)
    check_ranks(comm.size)
    check_contact(config, contact_from(config))
    name = Path(options.config or default_config()).stem
    directory = Path(options.out or Path("runs") / name)
    on_first_rank(comm, prepare_directory, directory, options.force)
    from mgehl.run import run

    result = run(config, directory, comm, speak=not options.quiet)
    if options.quiet and not result.converged and comm.rank == 0:
        print(f"mgehl: not converged: {result.reason}", file=sys.stderr)
    return CONVERGED if result.converged else NOT_CONVERGED


def _study(options, comm):
    from importlib import import_module

    from mgehl.output.files import on_first_rank, prepare_directory
    from mgehl.studies.study import Study

    check_ranks(comm.size)
    nodes = _nodes(options.nodes)
    if options.study in DOUBLING:
        _check_doubling(nodes)
    if len(nodes) > LARGEST_LISTS.get(options.study, len(nodes)):
        raise ConfigError(
            f"--nodes {options.nodes}: study {options.study} {_TAKES[LARGEST_LISTS[options.study]]}"
        )
    directory = Path(options.out or Path("runs") / f"study-{options.study}")
    on_first_rank(comm, prepare_directory, directory, options.force, options.resume)
    study = Study(directory, comm, nodes, not options.quiet, branch=options.direction, mean=options.mean)
    if not options.resume:
        on_first_rank(comm, study.cache.clear)
    import_module(f"mgehl.studies.{options.study}").run(study)
    if options.quiet and study.failures and comm.rank == 0:
        print(f"mgehl: {study.failures} cases of the study did not converge", file=sys.stderr)
    return NOT_CONVERGED if study.failures else CONVERGED


def _check_doubling(nodes):
    for coarse, fine in zip(nodes[:-1], nodes[1:], strict=True):
        if fine != 2 * coarse - 1:
            raise ConfigError(
                f"--nodes {coarse},{fine}: {2 * coarse - 1} must follow {coarse} in this study"
            )


def _nodes(text):
    """The grids of --nodes, coarsest first, by the rules of grid.nodes."""
    if text is None:
        return ()
    return tuple(
        sorted({load_config(settings=[f"grid.nodes={each}"]).grid.nodes for each in text.split(",")})
    )


def _collect(options):
    from mgehl.output.table import collect, markdown, write_csv

    try:
        rows = collect(options.runs)
        if options.out:
            write_csv(Path(options.out), rows)
    except OSError as error:
        print(f"mgehl: {error.filename}: {error.strerror}", file=sys.stderr)
        return USAGE
    except (ValueError, KeyError) as error:
        print(f"mgehl: a file of these runs is damaged: {error}", file=sys.stderr)
        return USAGE
    columns = options.columns.split(",") if options.columns else list(rows[0])
    unknown = [column for column in columns if column not in rows[0]]
    if unknown:
        print(f"mgehl: --columns {unknown[0]}: known are {', '.join(rows[0])}", file=sys.stderr)
        return USAGE
    print(markdown(rows, columns))
    return CONVERGED


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
