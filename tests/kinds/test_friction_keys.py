import pytest
from told import refusal

from mgehl.config import config_from_tables
from mgehl.errors import ConfigError
from mgehl.kinds import contact_from


def friction(motion=None, **keys):
    config = config_from_tables({"friction": keys, "motion": {"slide_to_roll": 0.2} | (motion or {})})
    return contact_from(config).friction


@pytest.mark.parametrize(
    "motion, thinning, thins",
    [({}, {}, True), ({}, {"thinning": False}, False), ({"slide_to_roll": 0.0}, {}, False)],
)
def test_shear_thins_the_film_where_surfaces_slide_in_oil_with_an_eyring_stress(motion, thinning, thins):
    assert friction(motion, model="eyring", eyring_stress=5e6, **thinning).thins is thins


@pytest.mark.parametrize(
    "keys, message",
    [
        ({"model": "eyring"}, 'friction.eyring_stress: must be given where friction.model = "eyring"'),
        ({"model": "limiting"}, "friction.limiting_coefficient: must be given where"),
        ({"model": "newtonian", "eyring_stress": 5e6}, 'means nothing where friction.model = "newtonian"'),
        ({"eyring_stress": 5e6},
         "friction.eyring_stress = 5000000.0: means nothing without friction.model"),
        ({"model": "ree"}, "must be one of newtonian, eyring, limiting, FILE.py:FUNCTION"),
        ({"boundary_coefficient": -0.1},
         "friction.boundary_coefficient = -0.1: must be a number at least 0"),
        ({"boundary_coefficient": 3.0}, "must be a number at least 0 and at most 2"),
        ({"model": "limiting", "limiting_coefficient": 0.05, "thinning": True},
         "friction.thinning = True: needs friction.eyring_stress"),
    ],
)  # fmt: skip
def test_what_makes_no_friction_is_refused(keys, message):
    assert message in refusal(friction, **keys, error=ConfigError)


def test_a_film_at_an_angle_is_not_thinned():
    eyring = {"model": "eyring", "eyring_stress": 5e6}
    said = refusal(friction, {"angle": 30.0}, **eyring)
    assert "motion.angle = 30: with friction.thinning it must be a multiple" in said
    assert not friction({"angle": 30.0}, **eyring, thinning=False).thins
