"""What a rough contact is asked for is the same on any number of ranks."""

from dataclasses import asdict

import pytest
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.run import solve
from mgehl.studies import rough
from mgehl.studies.study import merged

pytestmark = pytest.mark.parallel

COMM = MPI.COMM_WORLD


@pytest.mark.parametrize("angle", [0.0, 90.0])
def test_film_and_contact_are_those_of_one_rank(angle):
    long_waves = {"surface": {"rms": 20e-9, "shortest_wavelength": 90e-6}}
    tables = merged(rough.case(65, 0.007, "contact", 10e-9), long_waves, {"motion": {"angle": angle}})
    config = config_from_tables(merged(tables, {"solver": {"error": False}}))
    together, alone = solve(config, COMM).result, solve(config, MPI.COMM_SELF).result
    assert together.converged and alone.converged
    assert together.mixed.patches == alone.mixed.patches > 1
    assert asdict(together.mixed) == pytest.approx(asdict(alone.mixed), rel=1e-6)
    assert COMM.allgather(together.mixed) == COMM.size * [together.mixed]
    assert together.mixed.contact_load_share == pytest.approx(together.contact.load_fraction, rel=1e-12)
    shares = together.mixed.contact_load_share + together.mixed.film_load_share
    assert shares == pytest.approx(1.0, abs=1e-7)
