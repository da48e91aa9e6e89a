"""The picture of a run."""

import warnings
from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_rgb

from mgehl.config import config_from_tables
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.model.hertz import hertz_pressure
from mgehl.output.film_error import NOT_ASKED
from mgehl.output.pictures import style
from mgehl.output.pictures.picture import drawn
from mgehl.output.result import Overlap
from mgehl.output.solution import Fields, Solution


@pytest.fixture
def mesh():
    return Mesh(33, 33, (-1.9, 1.3), (-1.5, 1.5))


@pytest.fixture
def fields(mesh):
    """A dry contact with film around it and a cavity behind it."""
    X, Y = mesh.X[None, :], mesh.Y[:, None]
    P = hertz_pressure(X, Y)
    status = np.where(P > 0.0, CONTACT, np.where(X > 0.5, CAVITATED, LUBRICATED))
    status[[0, -1]], status[:, [0, -1]] = BOUNDARY, BOUNDARY
    return Fields(P, np.maximum(X**2 + Y**2 - 1.0, 0.0), status.astype(np.int8))


@pytest.fixture
def solution(mesh, fields, paper_contact):
    """What the picture needs of a `Solution`."""
    return Solution(
        config_from_tables({}),
        paper_contact(),
        mesh,
        fields,
        [],
        SimpleNamespace(converged=True, settled=True, overlap=Overlap(0, 0.0), error=NOT_ASKED, mixed=None),
    )


@pytest.fixture
def image(tmp_path, solution):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        (tmp_path / "picture.png").write_bytes(drawn(solution))
    return plt.imread(tmp_path / "picture.png")[..., :3]


def share(image, colour):
    """Part of the pixels that have a colour."""
    with style.applied():
        rgb = np.array(to_rgb(colour))
    return float(np.mean(np.all(np.abs(image - rgb) < 0.01, axis=-1)))


def test_it_is_a_wide_image(image):
    height, width, _ = image.shape
    assert height > 400 and width > 2 * height


def test_the_map_has_the_contact_and_what_is_beyond_its_scale(image):
    for colour in (style.CONTACT_COLOUR, style.HIDDEN):
        assert share(image, colour) > 0.005


def test_the_curves_are_drawn(image):
    for colour in (style.PRESSURE, style.FILM):
        assert share(image, colour) > 5e-4


def test_the_map_shows_the_set_that_is_given(tmp_path, solution, image):
    status = solution.fields.status
    status[status == CONTACT] = LUBRICATED
    (tmp_path / "film.png").write_bytes(drawn(solution))
    film = plt.imread(tmp_path / "film.png")[..., :3]
    assert share(film, style.CONTACT_COLOUR) < 0.2 * share(image, style.CONTACT_COLOUR)


def test_no_figure_stays_open_and_no_style_is_left(image):
    assert plt.get_fignums() == []
    assert plt.rcParams["figure.dpi"] == plt.rcParamsDefault["figure.dpi"]
