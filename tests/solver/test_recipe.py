"""What a contact gets, by its peaks, its law and its start."""

import pytest

from mgehl.discretization.contact_law import BoundaryFilm, InterfaceConditions
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.scheme import Scheme
from mgehl.model.surface.shapes import Dent
from mgehl.model.surface.waviness import Waviness
from mgehl.solver.recipe import (
    COVERED,
    DRY,
    FULL_FILM,
    IN_CONTACT,
    NEAR,
    NONE,
    OF_ROUGH,
    OF_SMOOTH,
    THICK_FILM,
    TOUCHING,
    UNDER_FILM,
    UNDER_THIN_FILM,
    UNSEEN_FILM,
    couette_scheme_of,
    on_mesh,
    recipe_of,
)
from mgehl.solver.recipe_words import recipe_words
from mgehl.solver.settings import SolverSettings

CLOSING, CLOSED = BoundaryFilm(1e-6), InterfaceConditions(1e-6)


@pytest.fixture
def recipe(paper_contact):
    """Function: the recipe of the paper's ball at 1 m/s (film 390 nm), with waves of a size in m."""

    def made(amplitude=0.0, law=CLOSED, start="film", layers=None):
        surface = Waviness(amplitude, 2e-4, 2e-4) if amplitude else None
        contact = paper_contact(1.0, surface=surface)
        law = law if layers is None else BoundaryFilm(layers / contact.film_scale)
        return recipe_of(SolverSettings(scheme=Scheme(contact_law=law), start=start), contact)

    return made


@pytest.mark.parametrize(
    "amplitude, law, peaks, in_valleys, on_coarse_grids",
    [
        (0.0, CLOSED, NONE, False, True),
        (1e-8, CLOSING, COVERED, False, True),
        (6e-7, CLOSING, NEAR, True, True),
        (4e-6, CLOSING, TOUCHING, True, False),
        (4e-6, CLOSED, NEAR, True, True),
    ],
)
def test_peaks_decide_grids_and_smoother(recipe, amplitude, law, peaks, in_valleys, on_coarse_grids):
    made = recipe(amplitude, law)
    assert made.peaks == peaks
    assert (made.cycle.rough, made.cycle.in_valleys) == (peaks != NONE, in_valleys)
    assert made.on_coarse_grids == on_coarse_grids
    shut = (IN_CONTACT,) if law.closes_faces else ()
    assert made.otherwise == ((DRY, THICK_FILM) if peaks == TOUCHING else shut)
    assert made.newton.over_largest == (peaks != NONE)


def test_peaks_that_touch_begin_from_their_dry_contact(recipe):
    assert recipe(4e-6, CLOSING).begins == UNDER_FILM
    assert recipe(4e-6, CLOSING, start="contact").begins == UNDER_THIN_FILM
    assert recipe(4e-6, layers=1e-6).begins == DRY


def test_a_surface_that_comes_later_has_the_scheme_of_rough_bodies(paper_contact):
    dented = paper_contact(1.0, surface=Dent(1e-6, 1e-5, x=-1e-2))
    assert dented.roughness == 0.0
    assert couette_scheme_of(dented) == OF_ROUGH and couette_scheme_of(paper_contact(1.0)) == OF_SMOOTH
    assert recipe_of(SolverSettings(scheme=Scheme(contact_law=CLOSING)), dented).peaks == COVERED


@pytest.mark.parametrize(
    "speed, rest, begins",
    [(1.0, {}, FULL_FILM), (1e-2, {}, UNSEEN_FILM), (1e-2, {"mean": "logarithmic"}, UNSEEN_FILM),
     (1e-2, {"mean": "geometric"}, FULL_FILM), (1e-2, {"law": CLOSED}, FULL_FILM),
     (1e-2, {"start": IN_CONTACT}, IN_CONTACT), (1e-2, {"amplitude": 4e-6}, UNDER_FILM)],
)  # fmt: skip
def test_a_grid_that_hardly_sees_a_film_begins_alone_from_a_thicker_one(paper_contact, speed, rest, begins):
    """The paper's ball on 257 nodes: 5.3 and .5 cells in the inlet."""
    asked = {"amplitude": 0.0, "mean": "linear-gap", "law": CLOSING, "start": FULL_FILM} | rest
    surface = Waviness(asked["amplitude"], 2e-4, 2e-4) if asked["amplitude"] else None
    contact = paper_contact(speed, surface=surface)
    scheme = Scheme(face_mobility=asked["mean"], contact_law=asked["law"])
    settings = SolverSettings(scheme=scheme, start=asked["start"])
    mesh = Mesh(257, 257, (-1.9, 1.3), (-1.5, 1.5))
    made = recipe_of(on_mesh(settings, contact, mesh), contact)
    assert made.begins == begins
    assert made.on_coarse_grids == (begins == FULL_FILM)
    assert (made.newton.squeeze > 0.0) == (begins != FULL_FILM)


def test_its_words_name_what_else_it_begins_from(recipe):
    for made, told in (
        (
            recipe(4e-6, CLOSING),
            "where that fails, from the dry contact without oil, then from a thick film",
        ),
        (recipe(), "where that fails, from contact"),
    ):
        assert told in list(recipe_words(made, is_line=False))
    assert not any("fails" in words for words in recipe_words(recipe(1e-8, CLOSING), is_line=False))
