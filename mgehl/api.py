"""The Python interface: what the command line does, for scripts and notebooks.

    import mgehl

    config = mgehl.load("my.toml", {"grid.nodes": 129, "motion.speed": "0.5 m/s"})
    solution = mgehl.solve(config)
    print(solution)
    solution.film.min(), solution.summary.converged

The same under mpiexec, where every rank calls `solve`.
"""

from collections.abc import Iterable, Mapping
from os import PathLike
from typing import TYPE_CHECKING

from mgehl.config import Config, load_config

if TYPE_CHECKING:
    from mpi4py import MPI

    from mgehl.output.solution import Solution


def load(
    path: str | PathLike[str] | None = None, settings: Mapping[str, object] | Iterable[str] = ()
) -> Config:
    """Read a configuration (TOML, SI numbers or strings with units); default: the paper's ball.

    `settings` override keys of the file: {"grid.nodes": 129, ...} or ["grid.nodes=129", ...].
    Raises `mgehl.ConfigError`, one line that names the key, the value and what is allowed.
    """
    return load_config(path, settings)


def solve(
    config: Config,
    comm: "MPI.Comm | None" = None,
    *,
    start: "Solution | None" = None,
    speak: bool = False,
) -> "Solution":
    """Solve a configuration on the ranks of `comm` (default: all); collective.

    Returns the `Solution`, whether or not it converged: ask `.summary.converged`. `start` is another
    `Solution` to start from, of any grid and speed, with its fields on rank 0. With `speak`, rank 0 prints
    a line for each cycle. Raises `mgehl.ConfigError` where the values make no contact that can be solved,
    and `mgehl.UserError` where `start` is another kind of contact.
    """
    from mpi4py import MPI

    from mgehl.kinds import check_contact, contact_from
    from mgehl.output.terminal import SILENT, Lines
    from mgehl.run import Watch
    from mgehl.run import solve as solve_run
    from mgehl.solver.restart import check_start

    comm = MPI.COMM_WORLD if comm is None else comm
    check_contact(config, contact_from(config))
    if start:
        check_start(start, config.contact.kind)
    return solve_run(config, comm, Watch(Lines() if speak else SILENT), start)
