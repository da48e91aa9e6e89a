"""Whether the libraries that mgehl stands on have room, asked before they are called.

Without it MPI ends in many lines, and units seem not to be understood.
"""

import resource

from mgehl.errors import UserError

MiB = 2**20

LIBRARIES = 640 * MiB
"""Address space that MPI, PETSc, numba and the rest take before anything is solved. Measured: 611 MiB by
Debian's packages; below 585 MPI or a library failed in one of three ways."""


def check_address_space():
    """Raise UserError where a limit of this process (ulimit -v) is below what libraries take."""
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    if limit != resource.RLIM_INFINITY and limit < LIBRARIES:
        raise UserError(
            f"its libraries take {LIBRARIES / MiB:.0f} MiB of address space, and this shell allows "
            f"{limit / MiB:.0f} (ulimit -v)"
        )
