"""Whether a run has room in memory: asked before libraries are called that crash or hang without it."""

import resource
from pathlib import Path

from mgehl.errors import UserError
from mgehl.kinds import contact_from, mesh_from
from mgehl.output.forecast import MiB, bytes_of_rank, effort_of

SPARE = 128 * MiB
"""Bytes of buffers that BLAS and MPI take during a run."""


def check_memory(config, ranks):
    """Raise UserError where this process, one of so many ranks, may not take what it will (ulimit -v)."""
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    if limit == resource.RLIM_INFINITY:
        return
    contact = contact_from(config)
    mesh = mesh_from(config, contact)
    need = _taken() + SPARE + bytes_of_rank(effort_of(config, contact, mesh), mesh, ranks)
    if need > limit:
        raise UserError(
            f"grid.nodes = {config.grid.nodes}: takes about {need / MiB:.0f} MiB of address space, and "
            f"this shell allows {limit / MiB:.0f} (ulimit -v)"
        )


def _taken():
    """Bytes of address space that this process has."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    except (OSError, ValueError):
        return 0
