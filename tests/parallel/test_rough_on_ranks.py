from dataclasses import asdict

import pytest
from both import COMM, both

from mgehl.multigrid import valleys
from mgehl.studies.chance import BALL
from mgehl.studies.study import merged

pytestmark = pytest.mark.parallel

LONG_WAVES = merged(
    BALL,
    {"contact": {"load": 100.0, "boundary_film": 10e-9},
     "surface": {"rms": 20e-9, "hurst": 0.8, "shortest_wavelength": 90e-6, "seed": 1},
     "grid": {"nodes": 65}, "motion": {"speed": 0.012}},
)  # fmt: skip


def numbers(mixed):
    """Of a `MixedResult`, but for its bands."""
    return {name: value for name, value in asdict(mixed).items() if name != "error"}


@pytest.mark.parametrize("angle", [0.0, 90.0])
def test_film_and_contact_are_those_of_one_rank(angle):
    tables = merged(LONG_WAVES, {"solver": {"start": "contact"}, "motion": {"angle": angle}})
    together, alone = (each.result for each in both(tables, {"solver": {"error": True}}))
    assert together.mixed.patches == alone.mixed.patches > 1
    assert numbers(together.mixed) == pytest.approx(numbers(alone.mixed), rel=1e-6)
    bands, expected = together.mixed.error, alone.mixed.error
    assert bands.mean_nm > 0.0 and bands.how == expected.how
    assert bands.mean_nm == pytest.approx(expected.mean_nm, rel=1e-2)
    assert bands.loaded_nm == pytest.approx(expected.loaded_nm, rel=1e-2)
    assert COMM.allgather(together.mixed) == COMM.size * [together.mixed]
    assert together.mixed.contact_load_share == pytest.approx(together.contact.load_fraction, rel=1e-12)
    shares = together.mixed.contact_load_share + together.mixed.film_load_share
    assert shares == pytest.approx(1.0, abs=1e-7)


def test_so_are_they_where_nearby_nodes_are_solved_at_once(monkeypatch):
    """From the first relaxation on, on all grids but the coarsest."""
    monkeypatch.setattr(valleys, "PATIENCE", 0)
    found = both(LONG_WAVES, {"solver": {"start": "film", "error": False}})
    together, alone = (each.result for each in found)
    assert together.central_film_nm == pytest.approx(alone.central_film_nm, rel=1e-6)
    assert numbers(together.mixed) == pytest.approx(numbers(alone.mixed), rel=1e-6)
