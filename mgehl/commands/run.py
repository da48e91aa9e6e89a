"""mgehl run: solve one contact."""

import sys
from pathlib import Path

from mgehl.commands import CONVERGED, NOT_CONVERGED
from mgehl.config import check_ranks, default_config, load_config

PARALLEL = True


def add(commands):
    """Add the parser."""
    parser = commands.add_parser(
        "run",
        help="solve one contact",
        allow_abbrev=False,
        description="Solve one contact and write its directory.",
        epilog="example: mpiexec -n 2 python -m mgehl run --set grid.nodes=65 --set motion.speed='1 m/s'"
        " --set solver.start=film --out runs/film -mgehl_ksp_monitor",
    )
    parser.add_argument(
        "config", nargs="?", metavar="CONFIG", help="TOML file (default: the point contact)"
    )
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="settings",
                     help="set a key, such as grid.nodes=513; may be repeated")  # fmt: skip
    parser.add_argument("--out", metavar="DIR", help="directory of the results (default: runs/NAME)")
    parser.add_argument("--force", action="store_true", help="write into a directory that exists")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    return parser


def execute(options, comm):
    """Solve on all ranks and write the directory."""
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
