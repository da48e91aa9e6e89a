"""Bands from the films of grids."""

from math import hypot

import pytest

from mgehl.solver.richardson import (
    FASTER,
    IRREGULAR,
    OFF,
    SAFETY,
    SLOWEST,
    SMALLEST,
    SPREADS,
    SPREADS_OF_TWO,
    UNLIKE,
    UNSEEN,
    UNSEEN_UNLIKE,
    WIDER,
    band,
    band_beside,
    band_of_smallest,
    believed,
    by_chance,
    observed_order,
)


def values(limit, order, error, grids):
    """Films of grids, finest first, whose errors grow by the order."""
    return [limit - error * 2.0 ** (order * k) for k in range(grids)]


@pytest.mark.parametrize("order", [1, 2])
def test_where_errors_fall_by_the_order_the_error_is_told_and_a_part_added(order):
    films = values(30.0, order, 0.4, 3)
    assert band(films[0], films, 0.0, order).half_width == pytest.approx((1.0 + SAFETY) * 0.4)


@pytest.mark.parametrize("unlike, times", [(False, UNSEEN), (True, UNSEEN_UNLIKE)])
def test_of_two_grids_the_difference_around_the_centre_is_the_safety(unlike, times):
    """Errors of 0.3 at the centre and 0.4 around it, of second order."""
    films = values(30.0, 2, 0.3, 2)
    told = band(films[0], films, 3.0 * 0.4, 2, unlike).half_width
    assert told == pytest.approx((0.3**2 + (times * 0.4) ** 2) ** 0.5)
    agreeing = band(30.0, [30.0, 30.0], 3.0 * 0.4, 2, unlike).half_width
    assert agreeing == pytest.approx(times * 0.4)


def test_the_known_answer_of_three_grids():
    """0.0138174 0.0141711 0.0142608 tell 0.0142835 for the fourth grid; computed was 0.0142833."""
    films = [0.0142608, 0.0141711, 0.0138174]
    order = band(films[0], films, 0.0, 2).observed_order
    assert films[0] + (films[0] - films[1]) / 2.0**order == pytest.approx(0.0142835, abs=1e-7)


def test_what_a_node_is_off_the_film_between_nodes_it_is_off_the_limit():
    films = values(30.0, 2, 0.4, 3)
    above = band(films[0] + 0.1, films, 0.0, 2).half_width
    assert above == pytest.approx(0.3 + SAFETY * 0.4 + OFF * 0.1)
    below = band(films[0] - 0.1, films, 0.0, 2).half_width
    assert below == pytest.approx(0.5 + SAFETY * 0.4 + OFF * 0.1)


def test_a_difference_that_is_small_by_chance_does_not_make_a_small_band():
    films = [10.0, 10.01, 8.0]
    expected = 2.01 / 2.0 ** (2 + FASTER) / 3.0
    assert band(10.0, films, 0.0, 2).half_width > expected
    assert by_chance(2, -0.01, 2.01) == pytest.approx(expected - 0.01 / 3.0)


def test_a_last_difference_that_is_large_enough_lacks_nothing():
    assert by_chance(2, 1.0, 5.6) == 0.0


def test_slower_convergence_than_the_schemes_is_believed_down_to_a_part():
    assert believed(2, 1.6) == 1.6
    assert believed(2, 2.7) == 2
    assert believed(2, None) == 2
    assert believed(2, 2 * SLOWEST - 0.01) == 2


@pytest.mark.parametrize("order, part", [(1.9, SAFETY), (2.4, SAFETY), (1.4, IRREGULAR)])
def test_more_is_added_where_three_grids_show_another_order(order, part):
    films = [10.0, 9.0, 9.0 - 2.0**order]
    error = 1.0 / (2.0 ** believed(2, order) - 1.0)
    assert band(10.0, films, 0.0, 2).half_width == pytest.approx((1.0 + part) * error)


def test_no_order_is_seen_where_differences_change_their_sign():
    assert observed_order(1.0, -2.0) is None
    assert observed_order(1.0) is None
    assert observed_order(-1.0, -4.0) == 2.0


def test_a_film_of_first_order_is_told_of_by_the_limit_of_others():
    others = [9.0, 7.5]  # their limit 9.5
    assert band_beside(11.0, others, 2).half_width == pytest.approx(1.5 + 0.5)


def test_between_a_film_of_first_order_and_one_of_second_lies_the_limit():
    assert band_beside(11.0, [9.0], 2).half_width == pytest.approx(2.0)


def test_another_film_on_the_coarser_grid_makes_the_band_three_times_the_error():
    films = [10.0, 4.0, -20.0]
    assert band(10.0, films, 0.0, 2, unlike=True).half_width == pytest.approx((1.0 + UNLIKE) * 2.0)


def test_films_that_agree_by_chance_do_not_make_a_band_of_nothing():
    assert band(10.0, [10.0, 10.0, 10.0], 0.0, 2).half_width == pytest.approx(SMALLEST * 10.0)


class TestTheSmallestGap:
    """Errors of 0.4, of second order, that differ by 0.3 from node to node."""

    @pytest.mark.parametrize("unlike, wider", [(False, 1.0), (True, WIDER)])
    def test_its_safety_is_the_spread_of_the_difference(self, unlike, wider):
        films = values(30.0, 2, 0.4, 3)
        told = band_of_smallest(films[0], films, 0.9, 2, unlike)
        assert told.half_width == pytest.approx(0.4 + wider * SPREADS * 0.3)
        assert told.observed_order == pytest.approx(2.0)

    @pytest.mark.parametrize("unlike, wider", [(False, 1.0), (True, WIDER)])
    def test_of_two_grids_it_is_added_as_squares_are(self, unlike, wider):
        films = values(30.0, 2, 0.4, 2)
        told = band_of_smallest(films[0], films, 0.9, 2, unlike)
        assert told.half_width == pytest.approx(hypot((1.0 + SAFETY) * 0.4, wider * SPREADS_OF_TWO * 0.3))
        assert told.observed_order is None

    @pytest.mark.parametrize("off, least", [(-0.6, 1.0), (0.6, 0.6)])
    def test_the_error_makes_what_the_node_is_off_the_bottom_larger_but_not_smaller(self, off, least):
        films = values(30.0, 2, 0.4, 3)
        told = band_of_smallest(films[0] + off, films, 0.0, 2)
        assert told.half_width == pytest.approx(least + OFF * abs(off))

    def test_it_is_never_nothing(self):
        assert band_of_smallest(10.0, [10.0, 10.0], 0.0, 2).half_width == pytest.approx(SMALLEST * 10.0)
