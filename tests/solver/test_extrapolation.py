import numpy as np
import pytest

from mgehl.solver.extrapolation import alike, curvature


def test_the_curvature_of_a_parabola_is_found_from_uneven_times():
    times = np.array([0.1, 0.4, 0.5])
    values = 3.0 - 2.0 * times + 5.0 * times**2
    assert curvature(times, values) == pytest.approx(5.0)


def test_what_one_of_two_alone_tells_is_no_likeness():
    """A spike that jumps from node to node bends pressures one way, and then the other."""
    one, other = np.array([1.0, -2.0, 3.0, -1.0]), np.array([2.0, -1.0, -3.0, 0.0])
    assert alike(one, other) == pytest.approx([1.0, -1.0, 0.0, 0.0])
