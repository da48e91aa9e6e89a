"""What a run runs on: versions, PETSc and MPI as they were built, threads, FFTs, the machine."""

import os
import platform
import tempfile
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import petsc4py
from mpi4py import MPI
from petsc4py import PETSc

from mgehl.discretization.kernels import distribute
from mgehl.grid.transforms import FIXED, THREADS, TIMED
from mgehl.version import VERSION

COMPUTING = "numpy", "scipy", "mpi4py", "petsc4py", "pyfftw", "numba"
PACKAGES = *COMPUTING, "h5netcdf", "matplotlib", "pint", "dacite"
"""On which the numbers of a run depend; all that it uses."""

THREAD_VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


def surroundings(comm):
    """Everything, by sections, of the ranks of `comm` (collective); None is what is not there."""
    return {
        "versions": {"mgehl": VERSION, "python": platform.python_version()}
        | {package: _version(package) for package in PACKAGES},
        "petsc": _petsc(comm),
        "mpi": {
            "library": MPI.Get_library_version().splitlines()[0].strip("\0 "),
            "standard": ".".join(map(str, MPI.Get_version())),
            "ranks": comm.size,
        },
        "threads": {name: os.environ.get(name) for name in THREAD_VARIABLES},
        "fft": {"planner": " ".join(TIMED), "planner_of_lines": " ".join(FIXED), "threads": THREADS},
        "compiled": {"numba_cache": distribute.stats.cache_path},
        "machine": {
            "system": f"{platform.system()} {platform.release()} {platform.machine()}",
            "cores": os.cpu_count() or 1,
            "cores_allowed": cores_allowed(),
            "memory_GiB": memory_GiB(),
        },
    }


def cores_allowed():
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def memory_GiB():
    """Memory of the machine in GiB."""
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") / 2**30


def versions():
    """Name and version of what computes: mgehl, PETSc, packages; "unknown" where one does not say."""
    found = {"mgehl": VERSION, "petsc": _petsc_version()}
    return found | {package: _version(package) or "unknown" for package in COMPUTING}


def _version(package):
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def _petsc_version():
    return ".".join(map(str, PETSc.Sys.getVersion()))


def _petsc(comm):
    """How PETSc was built. `debug` makes it slow; with hypre a wedge's multigrid is BoomerAMG."""
    where, log, scalar = petsc4py.get_config(), _log(comm), PETSc.ScalarType()
    return {
        "version": _petsc_version(),
        "directory": where["PETSC_DIR"],
        "arch": where.get("PETSC_ARCH", ""),
        "precision": f"{scalar.dtype.name}, {scalar.itemsize} bytes",
        "integers": f"{8 * PETSc.IntType().itemsize} bits",
        "debug": "compiled with a debugging option" in log,
        "configured": log.partition("Configure options:")[2].partition("\n")[0].strip(),
        "hypre": bool(PETSc.Sys.hasExternalPackage("hypre")),
    }


def _log(comm):
    """What -log_view would print: the only place where PETSc tells how it was configured."""
    with tempfile.TemporaryDirectory() as directory:
        path = Path(comm.bcast(directory)) / "log"
        PETSc.Log.begin()
        viewer = PETSc.Viewer().createASCII(str(path), "w", comm=comm)
        PETSc.Log.view(viewer)
        viewer.destroy()
        text = path.read_text() if comm.rank == 0 else ""
    return comm.bcast(text)
