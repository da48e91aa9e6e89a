"""Speed and load that change: the courses, and how a film is compared with that of the time before."""

import numpy as np
import pytest

from mgehl.studies.courses import MEAN, PERIOD, STEADY, SWING, off


@pytest.mark.parametrize("way", [1e-4, 3e-4])
def test_a_film_of_the_time_before_is_off_by_nothing(way):
    t = np.linspace(0.0, PERIOD, 400)
    path = MEAN * (t + SWING * PERIOD / (2.0 * np.pi) * (1.0 - np.cos(2.0 * np.pi * t / PERIOD)))
    before = np.interp(path - way, path, t)
    u = MEAN * (1.0 + SWING * np.sin(2.0 * np.pi * before / PERIOD))
    rows = [{"time_s": each, "central_film_nm": h} for each, h in zip(t, 900.0 * u**0.67, strict=True)]
    films = 900.0 * np.array(STEADY) ** 0.67
    assert off(rows, films, way) < 1e-4 < 1e-2 < off(rows, films, 0.0)
