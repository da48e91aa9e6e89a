"""One run from a configuration to its directory."""

import time
from importlib.metadata import PackageNotFoundError, version

import numpy as np
from mpi4py import MPI
from petsc4py import PETSc

from mgehl.config import COARSEST_NODES
from mgehl.errors import OutputError
from mgehl.grid.grid import single_grid
from mgehl.grid.hierarchy import Hierarchy
from mgehl.output import files, progress
from mgehl.output.result import Work, summarise
from mgehl.output.solution import Fields, Solution
from mgehl.output.wedge_result import summarise_wedge
from mgehl.solver.continuation import begin
from mgehl.solver.from_config import (
    OPTIONS_PREFIX,
    contact_from,
    mesh_from,
    scheme_from,
    settings_from,
)
from mgehl.solver.nested import single_loop
from mgehl.solver.wedge import solve_wedge
from mgehl.version import VERSION


def run(config, directory, comm, speak=True):
    """Solve `config` on `comm`, write `directory` (from rank 0), return the result."""
    solution = solve(config, comm, speak)
    files.on_first_rank(comm, _write, directory, solution)
    if speak and comm.rank == 0:
        print(solution, f"  results in {directory}", sep="\n", flush=True)
    return solution.result


def solve(config, comm, speak=False):
    """Solve `config` on `comm`; return the `Solution`.

    A line contact has a single line, which belongs to one rank: every rank solves all of it.
    """
    started = time.perf_counter()
    contact = contact_from(config)
    kind, mesh = config.contact.kind, mesh_from(config, contact)
    if kind == "wedge":
        find, domain = _solve_wedge, single_grid(mesh, comm)
    else:
        on = MPI.COMM_SELF if kind == "line" else comm
        find, domain = _solve_loaded, Hierarchy(mesh, COARSEST_NODES, contact.kernel, on)
    try:
        with np.errstate(all="ignore"):  # an iteration that diverges says so itself
            found = find(config, contact, domain, started, speak and comm.rank == 0)
        problem, state, rows, result = found
        local = Fields(state.P, state.H, state.status)
        whole = local.gathered(problem.grid)
    finally:
        domain.destroy()
    if kind == "line":
        result = comm.bcast(result)  # ranks may differ in the last bit
    return Solution(config, contact, mesh, whole, rows, result, state.H0, local, problem.grid.first)


def _solve_loaded(config, contact, hierarchy, started, speak):
    """A point or a line contact, by either method."""
    settings = settings_from(config, contact)
    by_newton = settings.method == "newton-mg"
    lines = (progress.newton_row, progress.newton_line)
    if not by_newton:
        lines = (progress.sweep_row, progress.sweep_line)
    monitor = progress.Progress(*lines, contact.film_scale, lambda: hierarchy.convolutions, speak)
    method = begin if by_newton else single_loop
    problem, outcome = method(hierarchy, contact, settings, monitor)
    work = Work(hierarchy.convolutions, monitor.steps if by_newton else outcome.cycles[-1].step)
    wall = time.perf_counter() - started
    result = summarise(problem, outcome, settings.newton.tolerance, work, wall, versions())
    return problem, outcome.state, monitor.rows, result


def _solve_wedge(config, bearing, grid, started, speak):
    """A rigid bearing."""
    scheme, solver = scheme_from(config, bearing), config.solver
    limits = solver.tolerance, solver.max_steps
    problem, outcome = solve_wedge(grid, bearing, scheme, OPTIONS_PREFIX, *limits)
    wall = time.perf_counter() - started
    result = summarise_wedge(problem, outcome, wall, versions())
    rows = progress.wedge_rows(problem.grid.mesh.nx, outcome.cycles)
    if speak:
        print(*map(progress.wedge_line, rows), sep="\n", flush=True)
    return problem, outcome.state, rows, result


def versions():
    """Versions of what computes."""
    packages = ("numpy", "scipy", "mpi4py", "petsc4py", "pyfftw", "numba")
    found = {"mgehl": VERSION, "petsc": ".".join(map(str, PETSc.Sys.getVersion()))}
    for package in packages:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "unknown"
    return found


def _write(directory, solution):
    """Write all files; raise OutputError if the disk does not take them."""
    from mgehl.output import picture, wedge_picture  # matplotlib is slow to import

    paths = files.RunFiles(directory)
    config, mesh, fields = solution.config, solution.mesh, solution.fields
    try:
        files.write_config(paths.configuration, config)
        files.write_history(paths.history, solution.rows)
        files.write_fields(paths.fields, solution)
        if config.contact.kind == "wedge":
            files.write_center_line(paths.center_line, mesh, fields)
            wedge_picture.draw(paths.picture, solution)
        else:
            picture.draw(paths.picture, solution)
        files.write_result(paths.result, solution.result)
    except OSError as error:
        raise OutputError(f"{directory}: cannot be written: {error}") from None
