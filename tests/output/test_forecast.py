"""What is foretold agrees with what runs do, as far as it claims to."""

import pytest
from mpi4py import MPI
from places import CONFIGS

from mgehl.config import load_config
from mgehl.kinds import contact_from, mesh_from
from mgehl.output import forecast as module
from mgehl.output.forecast import MiB, forecast
from mgehl.run import solve


def film(nodes=257, speed=0.0075, **changes):
    settings = {"grid.nodes": nodes, "motion.speed": speed, "solver.start": "film"} | changes
    return load_config(settings=settings)


@pytest.fixture
def one_second(monkeypatch):
    """A machine on which the timed convolution takes a second."""
    monkeypatch.setattr(module, "time_convolution", lambda mesh: 1.0)
    monkeypatch.setattr(module, "cores_allowed", lambda: 2)


def foretold(config, ranks=1):
    contact = contact_from(config)
    return forecast(config, contact, mesh_from(config, contact), ranks)


@pytest.mark.parametrize(
    "name, settings",
    [("full_film", {"grid.nodes": 129, "motion.speed": 0.5}), ("point_contact", {"grid.nodes": 129}),
     ("rough", {"discretization.contact_model": "dry"})],
    ids=["full film", "contact", "dry"],
)  # fmt: skip
def test_runs_take_half_to_twice_the_convolutions(one_second, name, settings):
    """As the rough ball does in test_run_command.py."""
    config = load_config(CONFIGS / f"{name}.toml", settings)
    result = solve(config, MPI.COMM_SELF).result
    bands = 0.0 if config.is_dry else result.error.convolutions
    taken = result.work.convolutions + bands
    assert result.converged and 0.5 < taken / foretold(config).convolutions < 2.0


def test_memory_is_that_of_the_runs_that_were_measured(one_second):
    """A film on 4097 by 4097 nodes took 14.2 to 14.4 GiB on two ranks. On 257 nodes rough balls took 450 to
    680 MiB, with nearby nodes solved at once 1010 to 1100."""
    rough, smooth = foretold(load_config(CONFIGS / "rough.toml")), foretold(film(nodes=4097), 2)
    assert smooth.memory / 2**30 == smooth.most_memory / 2**30 == pytest.approx(14.3, rel=0.01)
    assert 450.0 < rough.memory / MiB < 680.0 < 1010.0 < rough.most_memory / MiB < 1130.0
