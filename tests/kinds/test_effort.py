"""What a run takes is known by its kind, start, mean and method."""

import pytest

from mgehl.config import load_config
from mgehl.kinds import line, loaded, point, wedge

FILM = {"solver.start": "film", "solver.error": False}


@pytest.mark.parametrize(
    "settings, effort",
    [
        (FILM, point.FILM),
        ({"solver.start": "contact"}, point.CONTACT),
        (FILM | {"discretization.face_mobility": "harmonic"}, point.MEAN),
        (FILM | {"discretization.face_mobility": "linear-gap"}, point.FILM),
        ({"contact.kind": "line", "solver.error": False}, line.EFFORT),
        ({"contact.kind": "wedge"}, wedge.EFFORT),
    ],
    ids=["film", "contact", "mean", "linear gap", "line", "wedge"],
)
def test_effort_is_that_of_such_runs(settings, effort):
    config = load_config(settings=settings)
    assert config.kind.effort(config) == effort


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
