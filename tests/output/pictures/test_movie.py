"""The movie of a run in time."""

from types import SimpleNamespace

import numpy as np
import pytest

from mgehl.discretization.status import LUBRICATED
from mgehl.output.pictures.movie import SHOWN, halves


def test_it_holds_the_largest_contact_of_all_frames():
    """It was cut to that of the first load."""
    x, y = np.linspace(-3.0, 3.0, 61), np.linspace(-2.0, 2.0, 41)
    solution = SimpleNamespace(x=x, y=y, contact=SimpleNamespace(x_scale=0.5, y_scale=0.25))

    def frame(a, b):
        pressure = np.maximum(1.0 - np.hypot(x[None, :] / a, y[:, None] / b), 0.0)
        return 0.0, {"pressure": pressure, "status": np.full(pressure.shape, LUBRICATED)}

    frames = frame(0.4, 0.2), frame(2.05, 1.05)
    shown = [[*halves(solution, some)] for some in (frames[:1], frames)]
    assert shown[0] == pytest.approx([500.0 * SHOWN, 250.0 * SHOWN])
    assert shown[1] == pytest.approx([1800.0 * SHOWN, 900.0 * SHOWN])
