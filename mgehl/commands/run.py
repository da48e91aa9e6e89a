"""mgehl run: solve one contact

Solve one contact and write its directory. A run that was stopped, or killed, goes on with --resume, on
any number of ranks. SIGTERM, Ctrl-C and --time-limit save it first (exit status 143, 130 and 143);
under mpiexec within the two seconds that Open MPI gives it.

example: mpiexec -n 2 python -m mgehl run --set grid.nodes=65 --set motion.speed='1 m/s' --set
    solver.start=film --out runs/film -mgehl_ksp_monitor
"""

from pathlib import Path
from shlex import quote

from mgehl.commands import CONVERGED, NOT_CONVERGED, add_configuration, add_settings, shown
from mgehl.config import config_from_tables, not_given, read_tables
from mgehl.config_file import chosen_config, naming_file
from mgehl.config_value import read_quantity
from mgehl.errors import OutputError, UserError

NO_ERROR = "solver.error=false"

NOT_WITH_RESUME = {
    "config": "CONFIG", "settings": "--set", "out": "--out", "force": "--force",
    "start_from": "--start-from", "no_error": "--no-error",
}  # fmt: skip
"""What a run that goes on has already, as it is typed."""


def add(parser):
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
    how.add_argument("--verbose", action="store_true", help="print all of each cycle and of the result")


def execute(options, comm):
    """Solve on all ranks and write the directory."""
    options.save_every = read_quantity("--save-every", options.save_every, "s")
    if options.time_limit:
        options.time_limit = read_quantity("--time-limit", options.time_limit, "s")
    result = _resume(options, comm) if options.resume else _begin(options, comm)
    return CONVERGED if result.converged else NOT_CONVERGED


def _solve(case, directory, comm, options, start):
    """Solve in a directory that is locked; a signal or a limit of time may stop it."""
    from mgehl.output.terminal import SILENT, speaker
    from mgehl.run import Watch, run
    from mgehl.stopping import StopWhenTold

    spoken = speaker(options.quiet, options.json_lines, verbose=options.verbose)
    words = spoken if comm.rank == 0 else SILENT
    hint = f"go on with: mgehl run --resume {quote(str(directory))}"
    with StopWhenTold(hint, options.time_limit) as stop, words:
        watch = Watch(words, save_every=options.save_every, stop=stop)
        return run(case, directory, comm, watch, start, options.start_from)


def _begin(options, comm):
    """Solve a new run in its directory, which is made and locked."""
    from mgehl.output.directory import make_directory, prepare_directory
    from mgehl.output.files import on_first_rank
    from mgehl.output.laws import law_files
    from mgehl.output.lock import locked
    from mgehl.run import enter

    settings = [*options.settings, *([NO_ERROR] if options.no_error else [])]
    file = chosen_config(options.config, options.settings)
    with naming_file(file, settings):
        tables = read_tables(file, settings)
        config = config_from_tables(tables)
        start = _start(options.start_from, comm) if options.start_from else None
        case = enter(config, comm, start)
    on_first_rank(comm, _complain, doubts(case.config, case.contact))
    if start:
        on_first_rank(comm, _check_start, options.start_from, start, case)
    if start and comm.rank == 0:
        _complain(_differences(options.start_from, start, case.config))
    directory = Path(options.out or Path("runs") / file.stem)
    if start and directory.resolve() == Path(options.start_from).resolve():
        raise UserError(f"--start-from {directory}: is the run's own directory; choose another with --out")
    on_first_rank(comm, make_directory, directory, options.force)
    with locked(comm, directory):
        on_first_rank(comm, prepare_directory, directory, law_files(case.config).values())
        if comm.rank == 0 and not (options.quiet or options.json_lines):
            _say_what(options, file, case, tables)
        return _solve(case, directory, comm, options, start)


def _complain(lines):
    from mgehl.saying import complain

    for line in lines:
        complain(line)


def _say_what(options, file, case, tables):
    """Say which configuration is solved where none was named, what it does not give, what is unusual."""
    from mgehl.kinds.choice import given
    from mgehl.kinds.plausible import implausible
    from mgehl.saying import mention

    changed, config = ", changed by --set" if options.settings else "", case.config
    which = [] if options.config else [f"no configuration named: solving {shown(file)}{changed}"]
    which += [f"not given: {words}" for words in not_given(config, tables).values()]
    if idle := given(tables, sorted(config.unused)):
        which.append(f"not used: {', '.join(idle)}: nothing to a {config.kind.noun}")
    odd = implausible(config, case.contact, options.start_from is not None)
    which += [f"unusual: {words}" for words in odd]
    for words in which:
        mention(words)


def doubts(config, contact):
    """Lines about heights that may be errors."""
    from mgehl.output.surface import surface_doubts

    return surface_doubts(config, contact) if config.kind.is_loaded else ()


def _differences(directory, start, config):
    """What differs in another contact from which a run starts: a first guess, and maybe a bad one; in time
    the film that it begins with."""
    from mgehl.output.laws import content_of, law_files
    from mgehl.solver.restart import differing_keys

    keys = list(differing_keys(start, config))
    theirs = {Path(file).name: content_of(file) for file in law_files(start.config)}
    for file in law_files(config):
        if theirs.get(Path(file).name, content_of(file)) != content_of(file):
            keys.append(Path(file).name)
    what_for = "this run begins with its film" if config.is_in_time else "a first guess only"
    if keys:
        yield f"--start-from {directory}: is of another contact ({', '.join(keys)}): {what_for}"
    if not start.result.settled:
        yield f"--start-from {directory}: has not converged: {what_for}"


def _start(directory, comm):
    """The `Solution` of another run, whole on every rank."""
    from mgehl.output.files import on_first_rank
    from mgehl.output.solution import on_every_rank
    from mgehl.output.stored import read_run

    return on_every_rank(comm, on_first_rank(comm, read_run, directory))


def _check_start(directory, start, case):
    """Raise UserError where a `Solution` read from there cannot start a case, of another kind for one."""
    from mgehl.solver.restart import check_start

    try:
        check_start(start, case)
    except UserError as error:
        raise UserError(f"--start-from {directory}: {error}") from None


def _resume(options, comm):
    """Go on with a run in its directory, which is locked; draw the missing picture of a finished one."""
    from mgehl.output.files import on_first_rank
    from mgehl.output.finish import draw_missing, taken_up
    from mgehl.output.lock import locked
    from mgehl.output.solution import on_every_rank

    for name, word in NOT_WITH_RESUME.items():
        if getattr(options, name):
            raise UserError(f"--resume {options.resume}: goes on as it began, without {word}")
    directory, speaks = Path(options.resume), not (options.quiet or options.json_lines)
    on_first_rank(comm, _check_run, directory)
    with locked(comm, directory):
        config, start, said = on_first_rank(comm, taken_up, directory) or (None, None, ())
        if speaks:
            _complain(said)
        told, start = comm.bcast(config), on_every_rank(comm, start)
        if told is not None:
            return _solve(told, directory, comm, options, start)
        result = on_first_rank(comm, draw_missing, directory)
        if speaks and comm.rank == 0:
            from mgehl.saying import say

            say(f"mgehl: {directory} has finished: its results are there")
        return comm.bcast(result)


def _check_run(directory):
    from mgehl.output.checkpoint import is_begun
    from mgehl.output.files import FIELDS

    if not ((directory / FIELDS).exists() or is_begun(directory)):
        raise OutputError(
            f"--resume {directory}: is no run directory: it has no {FIELDS} and no checkpoint"
        )
