"""The scale of a map of the film."""

import numpy as np
import pytest
from matplotlib.colors import LogNorm, Normalize

from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.output.pictures.film_scale import DECADES, film_scale, levels_of

X = np.linspace(-2.0, 2.0, 41)
DISTANCE = np.hypot(X[None, :], X[:, None])


def scale(film, contact=0.0):
    """Of a film with a disc of contact."""
    return film_scale(DISTANCE, film, np.where(DISTANCE < contact, CONTACT, LUBRICATED))


def film_of(inside, outside=1e5):
    return np.where(DISTANCE < 1.0, inside, outside)


def test_nothing_inside_is_beyond_it():
    """A side lobe of half the film, and an inlet of twice: no film inside is cut off, all outside is."""
    film = film_of(100.0)
    film[12, 20], film[20, 12] = 50.0, 200.0
    norm = scale(film)
    assert type(norm) is Normalize and (norm.vmin, norm.vmax) == (50.0, 200.0)


def test_a_thinnest_film_outside_of_the_zone_is_on_it():
    """That of a coated ball lies at its edge."""
    film = film_of(100.0)
    film[8, 20] = 40.0
    assert scale(film).vmin == 40.0


def test_logarithmic_where_films_differ_much():
    film = film_of(100.0)
    film[20, 20] = 12.6
    assert type(scale(film)) is Normalize
    film[20, 20] = 12.4
    assert isinstance(scale(film), LogNorm)
    film[20, 20] = 1e-9
    assert scale(film).vmax == pytest.approx(DECADES * scale(film).vmin)


def test_of_one_film_has_room_about_it():
    norm = scale(film_of(100.0))
    assert norm.vmin < 95.0 and 105.0 < norm.vmax


def test_without_any_film():
    assert scale(np.zeros_like(DISTANCE)).vmax == 10.0


def test_about_the_contact_where_it_is_full():
    """Then the film about it makes the scale, not the wide gap farther away."""
    norm = scale(np.maximum(1000.0 * (DISTANCE - 1.0), 0.0), contact=1.01)
    assert 0.0 < norm.vmin < norm.vmax < 250.0


def test_round_numbers_within_it():
    assert levels_of(Normalize(101.0, 199.0)).tolist() == [120.0, 140.0, 160.0, 180.0]
    np.testing.assert_allclose(levels_of(LogNorm(0.8, 30.0)), [1.0, 2.0, 5.0, 10.0, 20.0])
