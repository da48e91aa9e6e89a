"""Processes of their own that tests begin, of one rank or of several."""

import os

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
