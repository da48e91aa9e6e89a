"""What a run takes is known by its kind, start, mean and method."""

import pytest

from mgehl.config import load_config
from mgehl.kinds import line, loaded, point


@pytest.mark.parametrize("kind, own", [("point", point.FILM), ("line", line.EFFORT)])
def test_bands_about_films_take_convolutions_more(kind, own):
    config = load_config(settings={"contact.kind": kind, "solver.start": "film"})
    effort = config.kind.effort(config)
    assert effort.convolutions == own.convolutions + loaded.BANDS and "bands" in effort.measured


@pytest.mark.parametrize("kind", ["point", "line"])
def test_the_relaxation_makes_a_convolution_a_sweep(kind):
    sweeps = {"contact.kind": kind, "solver.method": "relaxation", "relaxation.max_sweeps": 7}
    config = load_config(settings=sweeps)
    effort = config.kind.effort(config)
    assert effort.convolutions == 7.0 and effort.measured == loaded.RELAXATION.measured
