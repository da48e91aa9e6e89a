"""mgehl run: solve one contact."""

from pathlib import Path
from shlex import quote

from mgehl.commands import CONVERGED, NOT_CONVERGED, add_configuration, add_settings
from mgehl.config import default_config, load_config
from mgehl.config_value import read_quantity
from mgehl.errors import OutputError, UserError

PARALLEL = True

NO_ERROR = "solver.error=false"


def add(commands):
    """Add the parser."""
    parser = commands.add_parser(
        "run",
        help="solve one contact",
        allow_abbrev=False,
        description="Solve one contact and write its directory. A run that was stopped, or killed, goes on "
        "with --resume, on any number of ranks. SIGTERM, Ctrl-C and --time-limit save it first "
        "(exit status 143, 130 and 143).",
        epilog="example: mpiexec -n 2 python -m mgehl run --set grid.nodes=65 --set motion.speed='1 m/s'"
        " --set solver.start=film --out runs/film -mgehl_ksp_monitor",
    )
    add_configuration(parser)
    add_settings(parser)
    parser.add_argument("--out", metavar="DIR", help="directory of the results (default: runs/NAME)")
    parser.add_argument("--force", action="store_true", help="write into a directory that exists")
    parser.add_argument("--resume", metavar="RUN", help="go on with the run of this directory")
    parser.add_argument("--start-from", metavar="RUN", help="start from the fields of a finished run")
    parser.add_argument(
        "--save-every", metavar="T", default="60", help="seconds between saves (default: 60)"
    )
    parser.add_argument("--time-limit", metavar="T", help="save and stop after so long, such as '2 hours'")
    parser.add_argument(
        "--no-error", action="store_true", help="no bands about the films: as solver.error=false"
    )
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--quiet", action="store_true", help="print nothing but errors")
    how.add_argument("--json-lines", action="store_true", help="print a JSON object per cycle")
    return parser


def execute(options, comm):
    """Solve on all ranks and write the directory."""
    save_every = read_quantity("--save-every", options.save_every, "s")
    limit = options.time_limit and read_quantity("--time-limit", options.time_limit, "s")
    if options.resume and _has_finished(options):
        result = _finished(options, comm)
    else:
        config, directory, start = (_taken_up if options.resume else _new)(options, comm)
        result = _run(config, directory, comm, start, options, save_every, limit)
    return CONVERGED if result.converged else NOT_CONVERGED


def _run(config, directory, comm, start, options, save_every, limit):
    """Solve, watched by whoever may stop it."""
    from mgehl.output.terminal import SILENT, speaker
    from mgehl.run import Watch, run
    from mgehl.stopping import StopWhenTold

    words = speaker(options.quiet, options.json_lines) if comm.rank == 0 else SILENT
    hint = f"go on with: mgehl run --resume {quote(str(directory))}"
    with StopWhenTold(hint, limit) as stop, words:
        return run(config, directory, comm, Watch(words, save_every=save_every, stop=stop), start)


def _new(options, comm):
    """Configuration, directory and start of a new run, its directory made."""
    from mgehl.kinds import check_contact, contact_from
    from mgehl.output.checkpoint import keep_start
    from mgehl.output.files import on_first_rank, prepare_directory

    settings = [*options.settings, *([NO_ERROR] if options.no_error else [])]
    config = load_config(options.config, settings)
    check_contact(config, contact_from(config))
    start = _start(options.start_from, config, comm) if options.start_from else None
    name = Path(options.config or default_config()).stem
    directory = Path(options.out or Path("runs") / name)
    if start and directory.resolve() == Path(options.start_from).resolve():
        raise UserError(f"--start-from {directory}: is the run's own directory; choose another with --out")
    on_first_rank(comm, prepare_directory, directory, options.force)
    if start:
        on_first_rank(comm, keep_start, directory, options.start_from)
    return config, directory, start


def _has_finished(options):
    """Whether the run to go on with has a result. Raises UserError where there is none to go on with."""
    from mgehl.output.files import RunFiles

    given = [
        name
        for name in ("config", "settings", "out", "force", "start_from", "no_error")
        if getattr(options, name)
    ]
    if given:
        raise UserError(f"--resume {options.resume}: goes on as it began, without {_WORDS[given[0]]}")
    files = RunFiles(options.resume)
    if not files.configuration.exists():
        raise OutputError(
            f"--resume {options.resume}: is no run directory: {files.configuration} is missing"
        )
    return files.result.exists()


def _finished(options, comm):
    """The result of a run that has finished; what a kill left of its checkpoint goes."""
    from mgehl.output.checkpoint import clear
    from mgehl.output.files import RunFiles
    from mgehl.output.stored import read_result

    files = RunFiles(options.resume)
    result = read_result(files, load_config(files.configuration))
    if comm.rank == 0:
        clear(files.directory)
        if not (options.quiet or options.json_lines):
            print(f"mgehl: {options.resume} has finished: its results are there")
    return result


def _taken_up(options, comm):
    """Configuration, directory and start of a run that goes on."""
    from mgehl.output.checkpoint import start_of
    from mgehl.output.files import RunFiles

    files = RunFiles(options.resume)
    config, start = load_config(files.configuration), start_of(files.directory)
    return config, files.directory, _start(start, config, comm) if start.is_dir() else None


_WORDS = {
    "config": "CONFIG",
    "settings": "--set",
    "out": "--out",
    "force": "--force",
    "start_from": "--start-from",
    "no_error": "--no-error",
}


def _start(directory, config, comm):
    """The `Solution` of another run, whole on every rank; it must be of the same kind."""
    from mgehl.output.files import on_first_rank
    from mgehl.output.stored import read_run
    from mgehl.solver.restart import check_start

    start = on_first_rank(comm, read_run, directory) or read_run(directory)
    try:
        check_start(start, config.contact.kind)
    except UserError as error:
        raise UserError(f"--start-from {directory}: {error}") from None
    return start
