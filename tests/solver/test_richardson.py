"""Bands from the films of grids."""

import pytest

from mgehl.solver.richardson import (
    FASTER,
    SAFETY,
    band,
    by_chance,
)


def values(limit, order, error, grids):
    """Films of grids, finest first, whose errors grow by the order."""
    return [limit - error * 2.0 ** (order * k) for k in range(grids)]


@pytest.mark.parametrize("order", [1, 2])
def test_where_errors_fall_by_the_order_the_error_is_told_and_a_part_added(order):
    films = values(30.0, order, 0.4, 3)
    assert band(films[0], films, 0.0, order).half_width == pytest.approx((1.0 + SAFETY) * 0.4)


def test_the_known_answer_of_three_grids():
    """0.0138174 0.0141711 0.0142608 tell 0.0142835 for the fourth grid; computed was 0.0142833."""
    films = [0.0142608, 0.0141711, 0.0138174]
    order = band(films[0], films, 0.0, 2).observed_order
    assert films[0] + (films[0] - films[1]) / 2.0**order == pytest.approx(0.0142835, abs=1e-7)


def test_a_difference_that_is_small_by_chance_does_not_make_a_small_band():
    films = [10.0, 10.01, 8.0]
    expected = 2.01 / 2.0 ** (2 + FASTER) / 3.0
    assert band(10.0, films, 0.0, 2).half_width > expected
    assert by_chance(2, -0.01, 2.01) == pytest.approx(expected - 0.01 / 3.0)
