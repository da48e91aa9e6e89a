import io
import warnings

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_rgb

from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.output.pictures import style
from mgehl.output.pictures.figures import figures, run_picture


def image_of(solution):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return plt.imread(io.BytesIO(run_picture(solution)))[..., :3]


def share(image, colour):
    with style.applied():
        rgb = np.array(to_rgb(colour))
    return float(np.mean(np.all(np.abs(image - rgb) < 0.01, axis=-1)))


def test_it_is_a_wide_image_of_curves_and_a_map(make_solution):
    solution = make_solution(contact=0.7)
    image = image_of(solution)
    height, width, _ = image.shape
    assert height > 400 and width > 2 * height
    for colour in (style.PRESSURE, style.FILM):
        assert share(image, colour) > 5e-4
    for colour in (style.CONTACT_COLOUR, style.HIDDEN):
        assert share(image, colour) > 0.005
    solution.fields.status[solution.status == CONTACT] = LUBRICATED
    assert share(image_of(solution), style.CONTACT_COLOUR) == 0.0


@pytest.mark.parametrize("kind", ["make_line", "make_wedge"])
def test_of_a_line_contact_and_a_wedge(kind, request):
    assert share(image_of(request.getfixturevalue(kind)()), style.PRESSURE) > 5e-4


def test_a_line_contact_and_a_wedge_have_what_makes_sense(make_line, make_wedge):
    assert [picture.name for picture in figures(make_line())] == ["lines", "history"]
    assert [picture.name for picture in figures(make_wedge())] == ["lines", "pressure", "status", "history"]
