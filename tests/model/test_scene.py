import pytest

from mgehl.config import load_config
from mgehl.kinds import contact_from
from mgehl.kinds.time import scene_of

WAVES = {"surface.kind": "waviness", "surface.amplitude": 1e-8, "surface.wavelength_x": 1e-4}


def scene(settings):
    config = load_config(settings={"time.end": 1.0, "grid.nodes": 65, "motion.speed": 0.1} | settings)
    return scene_of(config, contact_from(config))


@pytest.mark.parametrize(
    "body, slide_to_roll, lengths",
    [
        ("still", 1.0, 1.0),
        ("body_1", 1.0, 1.0),  # faster than the mean surface
        ("body_2", 1.0, 2.0),
        ("body_1", -1.9, 20.0),
        ("body_2", 2.5, 4.0),  # against the motion
        ("body_2", 2.0, 1.0),  # it rests, and never passes
    ],
)
def test_a_passage_is_that_of_the_slowest_heights(body, slide_to_roll, lengths):
    found = scene(WAVES | {"surface.body": body, "motion.slide_to_roll": slide_to_roll})
    assert found.passage == pytest.approx(lengths * 2.0 * found.framed.x_scale)


def test_ridges_along_the_motion_do_not_pass():
    ridges = {"surface.kind": "waviness", "surface.amplitude": 1e-8, "surface.wavelength_y": 1e-4}
    found = scene(ridges | {"surface.body": "body_2", "motion.slide_to_roll": 1.0})
    assert found.passage == pytest.approx(2.0 * found.framed.x_scale)
