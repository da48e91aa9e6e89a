"""In time, too, the answer is that of one rank. Run as `mpiexec -n 2 python -m pytest -m parallel`."""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.run import solve

pytestmark = pytest.mark.parallel

COMM = MPI.COMM_WORLD
BALL = {
    "contact": {"load": 15.0, "radius_x": 0.0125, "radius_y": 0.0125, "reduced_modulus": 110e9},
    "lubricant": {"viscosity": 0.25, "viscosity_law": "roelands", "pressure_viscosity": 22e-9},
    "motion": {"speed": 0.09},
    "grid": {"nodes": 65, "x": [-3.0, 2.0], "y": [-2.5, 2.5]},
    "solver": {"start": "film", "error": False},
}
DENT = {"kind": "dent", "amplitude": 100e-9, "width": 60e-6, "body": "body_1", "x": -100e-6}


@pytest.mark.parametrize("angle", [0.0, 25.0])
def test_a_dent_that_passes(angle):
    """Solved to the last digits: a step may leave as much as time.tolerance says, by other digits each."""
    more = {
        "surface": DENT,
        "time": {"end": 2e-4, "tolerance": 1e-7},
        "motion": {"speed": 0.09, "angle": angle},
    }
    config = config_from_tables(BALL | more)
    together, alone = solve(config, COMM), solve(config, MPI.COMM_SELF)
    assert together.result.converged and alone.result.converged
    assert len(together.rows) == len(alone.rows) > 3
    fields, expected = COMM.bcast(together.fields), alone.fields
    np.testing.assert_array_equal(fields.status, expected.status)
    np.testing.assert_allclose(fields.H, expected.H, rtol=0.0, atol=1e-8 * np.abs(expected.H).max())
