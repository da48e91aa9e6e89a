"""A case solved by all ranks together, and by each alone."""

import numpy as np
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.run import solve
from mgehl.studies.study import merged

COMM = MPI.COMM_WORLD


def both(*tables):
    """Both solutions, which have converged."""
    config = config_from_tables(merged(*tables))
    together, alone = solve(config, COMM), solve(config, MPI.COMM_SELF)
    assert together.result.converged and alone.result.converged
    return together, alone


def same_fields(together, alone, P=1e-8, H=1e-9):
    """The fields of all ranks: the statuses of one, and its films to a part of the largest."""
    fields, expected = COMM.bcast(together.fields), alone.fields
    np.testing.assert_array_equal(fields.status, expected.status)
    np.testing.assert_allclose(fields.P, expected.P, rtol=0.0, atol=P)
    np.testing.assert_allclose(fields.H, expected.H, rtol=0.0, atol=H * np.abs(expected.H).max())
    return fields
