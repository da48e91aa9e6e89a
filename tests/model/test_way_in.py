"""Grubin's integral, by the length of the way to the contact."""

import numpy as np
import pytest

from mgehl.model.way_in import STEPS, WayIn


@pytest.fixture
def way_in():
    """To a wedge: its integral from s to the end is (h + 2 s)/(2 (h + s)^2)."""
    return WayIn(0.3, STEPS)


@pytest.mark.parametrize("way", [0.01, 0.3, 2.0, 50.0])
def test_what_is_missing_is_the_integral_beyond(way_in, way):
    part = 0.3 * (0.3 + 2.0 * way) / (0.3 + way) ** 2
    assert way_in.missing(way) == pytest.approx(-np.log1p(-part), rel=1e-2)


def test_the_way_of_what_is_missing(way_in):
    for way in (0.01, 1.0, 300.0):
        assert way_in.way(way_in.missing(way)) == pytest.approx(way, rel=1e-9)
