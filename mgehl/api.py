"""The Python interface: what the command line does, for scripts and notebooks.

    import mgehl

    config = mgehl.load("my.toml", {"grid.nodes": 129, "motion.speed": "0.5 m/s"})
    solution = mgehl.solve(config)
    print(solution)
    solution.summary.converged
    if solution.film is not None:  # on rank 0
        solution.film.min(), solution.plot("film"), solution.to_xarray(), solution.save("runs/my")
    slower = mgehl.solve(config.with_({"motion.speed": "0.4 m/s"}), start=solution)
    mgehl.read("runs/my")
    mgehl.sweep(config, {"motion.speed": "1e-3..1 m/s:10"}, "runs/speeds").mean_gap_nm.plot()

Under mpiexec every rank calls `solve` and `sweep`. Rank 0 has the fields, draws and saves; on the others
fields are None.
"""

import sys
from collections.abc import Iterable, Mapping
from os import PathLike
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any
from warnings import warn

from mgehl.config import Config, config_from_tables, not_given, read_tables
from mgehl.errors import ConfigError, Stopped
from mgehl.petsc_options import leave_signals_alone

if TYPE_CHECKING:
    import xarray
    from mpi4py import MPI

    from mgehl.answer import Solution

CONTACT = "contact", "lubricant", "body_1", "body_2"
"""Sections of settings that tell of another contact than the paper's ball."""


def load(
    path: str | PathLike[str] | None = None, settings: Mapping[str, object] | Iterable[str] = ()
) -> Config:
    """Read a configuration (TOML, SI numbers or strings with units); default: the paper's ball.

    `settings` override keys of the file: {"grid.nodes": 129, ...}, {"grid": {"nodes": 129}}
    or ["grid.nodes=129", ...]. A contact that no file gives is `Config().with_(settings)`: the paper's
    ball has the paper's scheme, domain and start, too, which is warned of. What makes the contact and is
    not given in a file is warned of as well: there the paper's values are taken.
    Raises `mgehl.ConfigError`, one line that names the key, the value and what is allowed.
    """
    if path == "":
        raise ConfigError('"": is no file')
    settings = settings if isinstance(settings, str | Mapping) else list(settings)
    tables = read_tables(path, settings)
    config = config_from_tables(tables)
    if path is None and any(str(name).startswith(CONTACT) for name in settings):
        warn(
            "no file: the paper's configuration, with its first-order scheme, domain and start, changed by "
            "the settings; mgehl.Config().with_(settings) has the program's own",
            stacklevel=2,
        )
    if path is not None and (missing := not_given(config, tables)):
        warn(f"{path}: not given: {', '.join(missing.values())}", stacklevel=2)
    return config


def read(directory: str | PathLike[str]) -> "Solution":
    """The `Solution` that a finished run left in its directory, on this rank.

    Functions of the user's own are not run: the directory may be anybody's; those of speed and load are
    kept at a thousand times. Raises `mgehl.UserError` where a file is missing, damaged, or not a run's.
    """
    leave_signals_alone()
    from mgehl.answer import Solution
    from mgehl.output.stored import read_run

    return Solution.of(read_run(directory))


def solve(
    config: Config | str | PathLike[str],
    comm: "MPI.Comm | None" = None,
    *,
    start: "Solution | str | PathLike[str] | None" = None,
    speak: bool = False,
) -> "Solution":
    """Solve a configuration, or that of a file, on the ranks of `comm` (default: all); collective.

    Returns the `Solution`, whether or not it converged: ask `.summary.converged`. `start` is another
    `Solution` to start from, of any grid and speed, with its fields on rank 0, or its run directory. With
    `speak`, rank 0 prints a line for each cycle. What is unusual in the input is warned of.

    Ctrl-C ends it before the next step, with KeyboardInterrupt; a second one ends it at once. Raises
    `mgehl.ConfigError` where the values make no contact that can be solved, and `mgehl.UserError` where
    `start` is another kind of contact, or one in time between other heights.
    """
    leave_signals_alone()
    from mpi4py import MPI

    _let_no_rank_wait(MPI.COMM_WORLD)
    config = _config_of(config)
    from mgehl.answer import Solution
    from mgehl.kinds.plausible import implausible
    from mgehl.output.files import on_first_rank
    from mgehl.output.solution import on_every_rank
    from mgehl.output.stored import read_run
    from mgehl.output.terminal import SILENT, Lines
    from mgehl.run import Watch, enter
    from mgehl.run import solve as solve_case
    from mgehl.solver.restart import check_start
    from mgehl.stopping import StopOnCtrlC

    comm = MPI.COMM_WORLD if comm is None else comm
    begin: Any = start
    if comm.bcast(isinstance(start, str | PathLike)):  # what rank 0 has decides
        begin = on_first_rank(comm, read_run, start)
    if comm.bcast(begin is None or hasattr(begin, "fields")):
        begin = on_every_rank(comm, begin)
    case = enter(config, comm, begin if hasattr(begin, "config") else None)
    if comm.rank == 0:
        for words in implausible(case.config, case.contact, begin is not None):
            warn(f"unusual: {words}", stacklevel=2)
    if comm.bcast(begin is not None):
        on_first_rank(comm, check_start, begin, case)
    try:
        with StopOnCtrlC() as stop:
            watch = Watch(Lines() if speak else SILENT, stop=stop)
            return Solution.of(solve_case(case, comm, watch, begin))
    except Stopped as stopped:
        told = str(stopped)
    # Not from within: its traceback would keep PETSc's objects until PETSc has ended, and crash then.
    raise KeyboardInterrupt(told)


def sweep(
    config: Config | str | PathLike[str],
    over: Mapping[str, str | Iterable[object]],
    directory: str | PathLike[str],
    comm: "MPI.Comm | None" = None,
) -> "xarray.Dataset":
    """Solve a contact at many values of keys, as `mgehl sweep --resume` does; collective.

    `over` has the values of each key, the fastest first: {"motion.speed": [0.1, 0.2], "contact.load":
    "50,100 N"}. Returns what sweep.nc holds: a dimension for each key, nan where there is no answer.
    """
    leave_signals_alone()
    import xarray
    from mpi4py import MPI

    _let_no_rank_wait(MPI.COMM_WORLD)
    from mgehl.run import Watch
    from mgehl.studies.points import axis_of, points_of
    from mgehl.studies.sweep import swept

    config, comm = _config_of(config), comm or MPI.COMM_WORLD
    axes = [axis_of(config, key, values) for key, values in over.items()]
    swept(directory, comm, axes, points_of(config, axes), Watch(), speak=False)
    return xarray.load_dataset(Path(directory) / "sweep.nc", engine="h5netcdf")


def _config_of(config: Config | str | PathLike[str]) -> Config:
    """A `Config`, or that of a file."""
    if config is None:
        raise ConfigError("config = None: must be a Config or a file")
    return config if isinstance(config, Config) else load(config)


def _let_no_rank_wait(comm: "MPI.Comm") -> None:
    """Have an error that a script does not catch end all ranks: the others would wait for this one. A
    `sys.exit` on one rank is not noticed."""
    if comm.size == 1 or sys.excepthook is not sys.__excepthook__:
        return

    def told_and_ended(
        kind: type[BaseException], error: BaseException, where: TracebackType | None
    ) -> None:
        sys.__excepthook__(kind, error, where)
        sys.stderr.flush()
        comm.Abort(130 if issubclass(kind, KeyboardInterrupt) else 1)

    sys.excepthook = told_and_ended
