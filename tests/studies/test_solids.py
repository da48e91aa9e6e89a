"""From which lambda on solids carry load: what the study asks for, and what it concludes."""

import numpy as np
import pytest

from mgehl.config import config_from_tables
from mgehl.studies.solids import SPEEDS, begin, case


def test_surfaces_stand_still_or_go_along_with_their_bodies():
    rest, moving = (config_from_tables(case(65, "Eyring", how, SPEEDS[0])) for how in ("at rest", "moving"))
    assert not rest.is_in_time and moving.is_in_time
    assert (moving.surface.body, moving.second_surface.body) == ("body_1", "body_2")
    assert rest.friction == moving.friction and rest.surface.seed == moving.surface.seed


def test_where_a_part_is_carried_is_exact_of_a_power():
    ratio = np.array([0.05, 0.1, 0.3])
    found = begin("Newtonian", "moving", ratio, 1e-5 / ratio**3)
    assert float(found["lambda at 1 %"]) == pytest.approx(0.1, rel=1e-2)
    assert found["lambda at 10 %"] == ""  # it is carried at no lambda that was looked at


def test_nothing_is_said_where_nothing_touches():
    assert begin("Newtonian", "at rest", *np.empty((2, 0)))["lambda at 1 %"] == ""
