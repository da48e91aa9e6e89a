"""Titles of pictures that show a film have its band."""

import pytest

from mgehl.output.film_error import FilmError, no_band
from mgehl.output.pictures import lines, maps, style
from mgehl.output.pictures.titles import title, title_with_films


@pytest.fixture
def banded(make_solution):
    """A solution whose films have bands."""
    solution = make_solution()
    solution.result.central_film_nm, solution.result.minimum_film_nm = 12.1436, 5.05
    solution.result.error = FilmError(0.37, 0.2, "of two grids")
    return solution


def test_films_are_on_a_second_line(banded):
    first, second = title_with_films(banded).splitlines()
    assert first == title(banded)
    assert second == "central film 12.1 ± 0.4 nm, minimum 5.0 ± 0.2 nm"


def test_without_bands_there_is_none(banded):
    banded.result.error = no_band("there is solid contact")
    assert title_with_films(banded) == title(banded)


@pytest.mark.parametrize("draw", [maps.film_map, lines.centre_lines])
def test_there_is_room_for_it(banded, draw, check_texts):
    with style.applied():
        figure = draw(banded)
        check_texts(figure)
    assert any("± 0.4 nm" in text.get_text() for text in figure.texts)
