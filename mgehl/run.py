"""One run from a configuration to its directory."""

import time
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version

import numpy as np
from petsc4py import PETSc

import mgehl
from mgehl.config import COARSEST_NODES
from mgehl.grid.hierarchy import Hierarchy
from mgehl.output import files
from mgehl.output.progress import Progress, trust_block
from mgehl.output.result import Work, summarise
from mgehl.solver.from_config import contact_from, mesh_from, settings_from
from mgehl.solver.nested import nested_iteration


@dataclass
class Fields:
    """Whole-grid fields (ny, nx) on rank 0."""

    P: np.ndarray
    H: np.ndarray
    status: np.ndarray


def run(config, directory, comm, speak=True):
    """Solve `config` on `comm`, write `directory` (from rank 0), return the `Result`."""
    started = time.perf_counter()
    first = comm.rank == 0
    contact = contact_from(config)
    settings = settings_from(config, contact)
    hierarchy = Hierarchy(mesh_from(config, contact), COARSEST_NODES, contact.deflection_scale, comm)
    progress = Progress(contact.film_scale, lambda: hierarchy.convolutions, speak and first)
    try:
        problem, outcome = nested_iteration(hierarchy, contact, settings, progress)
        work = Work(hierarchy.convolutions, progress.newton_steps)
        wall = time.perf_counter() - started
        result = summarise(problem, outcome, settings.newton.tolerance, work, wall, versions())
        state = outcome.state
        fields = Fields(*(problem.grid.gather(array) for array in (state.P, state.H, state.status)))
    finally:
        hierarchy.destroy()
    arguments = (directory, config, contact, problem.grid.mesh, fields, progress.rows, result)
    files.on_first_rank(comm, _write, *arguments)
    if speak and first:
        print(trust_block(result), f"  results in {directory}", sep="\n", flush=True)
    return result


def versions():
    """Versions of what computes."""
    packages = ("numpy", "scipy", "mpi4py", "petsc4py", "pyfftw", "numba")
    found = {"mgehl": mgehl.__version__, "petsc": ".".join(map(str, PETSc.Sys.getVersion()))}
    for package in packages:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "unknown"
    return found


def _write(directory, config, contact, mesh, fields, rows, result):
    """Write all files; raise OutputError if the disk does not take them."""
    from mgehl.output.picture import draw  # matplotlib is slow to import, and needed only here

    paths = files.RunFiles(directory)
    title = f"{1e3 * contact.speed:.4g} mm/s, {contact.load:.4g} N, {mesh.nx} x {mesh.ny} nodes: " + (
        "converged" if result.converged else "NOT converged"
    )
    try:
        files.write_config(paths.configuration, config)
        files.write_history(paths.history, rows)
        files.write_fields(paths.fields, mesh, contact, fields)
        draw(paths.picture, mesh, contact, fields, title)
        files.write_result(paths.result, result)
    except OSError as error:
        raise files.OutputError(f"{directory}: cannot be written: {error}") from None
