"""The map of a wedge's pressure."""

import numpy as np
import pytest

from mgehl.output.pictures import style
from mgehl.output.pictures.wedge_picture import SIGNED, pressure_picture, pressure_scale


def image_of(solution):
    with style.applied():
        figure = pressure_picture(solution)
    return figure.axes[0].get_images()[0]


def test_pressures_of_both_signs_have_two_colours_about_zero(make_wedge):
    solution = make_wedge()
    assert solution.fields.P.min() < 0.0 < solution.fields.P.max()
    image = image_of(solution)
    assert image.get_cmap().name == SIGNED and image.norm.vmin == -image.norm.vmax
    assert np.abs(np.ma.compressed(image.get_array())).max() == pytest.approx(image.norm.vmax)


def test_pressures_of_one_sign_have_the_colours_of_other_maps(make_wedge):
    solution = make_wedge()
    solution.fields.P[:] = np.abs(solution.fields.P)
    image = image_of(solution)
    assert image.get_cmap().name == "viridis" and 0.0 <= image.norm.vmin < image.norm.vmax


@pytest.mark.parametrize("low, high, ends", [(-0.026, 0.018, (-0.026, 0.026)), (-1.0, 3.0, (-3.0, 3.0))])
def test_zero_is_in_the_middle_of_the_scale(low, high, ends):
    norm, colours = pressure_scale(low, high)
    assert (norm.vmin, norm.vmax) == ends and colours == SIGNED


def test_a_trace_of_suction_is_none():
    norm, colours = pressure_scale(-1e-12, 1.0)
    assert (norm.vmin, norm.vmax) == (-1e-12, 1.0) and colours is None
