"""Whether a run has room in memory: asked before libraries are called that crash or hang without it."""

import resource
from pathlib import Path

from mgehl.errors import UserError
from mgehl.output.forecast import MiB, bytes_of_rank, effort_of

SPARE = 128 * MiB
"""Bytes of buffers that BLAS and MPI take during a run."""


def check_memory(case, ranks):
    """Raise UserError where one of so many ranks may not take what a `Case` needs (ulimit -v)."""
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    if limit == resource.RLIM_INFINITY:
        return
    effort = effort_of(case.config, case.contact, case.mesh)
    need = _taken() + SPARE + bytes_of_rank(effort, case.mesh, ranks)
    if need > limit:
        what, nodes = f"about {need / MiB:.0f} MiB of address space", case.config.grid.nodes
        raise UserError(
            f"grid.nodes = {nodes}: takes {what}, and this shell allows {limit / MiB:.0f} (ulimit -v)"
        )


def _taken():
    """Bytes of address space that this process has."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    except (OSError, ValueError):
        return 0
