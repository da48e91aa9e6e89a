"""Processes of their own that tests begin, of one rank or of several."""

import os
import subprocess
import sys

MGEHL = [sys.executable, "-m", "mgehl"]

LEFT_BY_MPI = (
    "OMPI_COMM", "PMIX_", "PRTE_", "PMI_",
    "OMPI_MCA_ess", "OMPI_MCA_pmix", "OMPI_MCA_orte_ess", "OMPI_MCA_orte_launch",
)  # fmt: skip
"""How the names begin of what MPI writes into the environment of a process that calls it."""


def own_environment(**variables):
    """The environment of a process that is to call MPI anew: this one's without what MPI left in it.

    It matters for processes of pytest-xdist, too: they inherit from one that may have imported MPI. Any
    `mpiexec` that sees what Open MPI's only rank leaves behind ends with status 1 and without a word.
    """
    kept = {name: value for name, value in os.environ.items() if not name.startswith(LEFT_BY_MPI)}
    return kept | variables


def ended(words, timeout=120, cwd=None, **variables):
    """A process that has ended, with what it said: on stderr but for MPI's libraries, which may have a say
    on the machine, "[hwloc/linux] ..."."""
    how = {"timeout": timeout, "cwd": cwd, "env": own_environment(**variables)}
    done = subprocess.run(words, capture_output=True, text=True, errors="replace", **how)
    own = [line for line in done.stderr.splitlines(keepends=True) if not line.startswith("[")]
    done.stderr = "".join(own)
    return done
