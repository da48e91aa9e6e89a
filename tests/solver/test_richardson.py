import pytest

from mgehl.solver.richardson import band, band_of_smallest, observed_order


def test_the_known_answer_of_three_grids():
    """0.0138174 0.0141711 0.0142608 tell 0.0142835 for the fourth grid; computed was 0.0142833."""
    films = [0.0142608, 0.0141711, 0.0138174]
    order = band(films[0], films, 0.0, 2).observed_order
    assert films[0] + (films[0] - films[1]) / 2.0**order == pytest.approx(0.0142835, abs=1e-7)


def test_a_difference_that_is_small_by_chance_does_not_make_a_small_band():
    pairs = [10.0, 9.5, 7.5], [10.0, 10.01, 8.0]
    by_their_order, by_chance = (band(10.0, films, 0.0, 2) for films in pairs)
    assert 0.1 * by_their_order.half_width < by_chance.half_width


def test_where_nothing_shows_the_order_a_band_holds_the_larger_difference():
    films = [10.0, 10.1, 10.25]
    assert band(10.0, films, 0.0, 2, unlike=True).half_width >= 0.15 > band(10.0, films, 0.0, 2).half_width


def test_no_order_is_seen_where_differences_change_their_sign():
    assert observed_order(1.0, -2.0) is None
    assert observed_order(1.0) is None
    assert observed_order(-1.0, -4.0) == 2.0


def test_films_that_agree_by_chance_do_not_make_a_band_of_nothing():
    assert band(10.0, [10.0, 10.0, 10.0], 0.0, 2).half_width > 0.0
    assert band_of_smallest(10.0, [10.0, 10.0], 0.0, 2).half_width > 0.0
