import pytest

from mgehl.solver.richardson import SAFETY, SPREADS, band, band_beside, band_of_smallest, observed_order


def values(limit, order, error, grids):
    """Films of grids, finest first, whose errors grow by the order."""
    return [limit - error * 2.0 ** (order * k) for k in range(grids)]


@pytest.mark.parametrize("order", [1, 2])
def test_where_errors_fall_by_the_order_the_error_is_told_and_a_part_added(order):
    films = values(30.0, order, 0.4, 3)
    like, unlike = (band(films[0], films, 0.0, order, unlike=each).half_width for each in (False, True))
    assert like == pytest.approx((1.0 + SAFETY) * 0.4) and unlike > like


def test_the_known_answer_of_three_grids():
    """0.0138174 0.0141711 0.0142608 tell 0.0142835 for the fourth grid; computed was 0.0142833."""
    films = [0.0142608, 0.0141711, 0.0138174]
    order = band(films[0], films, 0.0, 2).observed_order
    assert films[0] + (films[0] - films[1]) / 2.0**order == pytest.approx(0.0142835, abs=1e-7)


def test_a_difference_that_is_small_by_chance_does_not_make_a_small_band():
    pairs = [10.0, 9.5, 7.5], [10.0, 10.01, 8.0]
    by_their_order, by_chance = (band(10.0, films, 0.0, 2) for films in pairs)
    assert 0.1 * by_their_order.half_width < by_chance.half_width


def test_no_order_is_seen_where_differences_change_their_sign():
    assert observed_order(1.0, -2.0) is None
    assert observed_order(1.0) is None
    assert observed_order(-1.0, -4.0) == 2.0


def test_films_that_agree_by_chance_do_not_make_a_band_of_nothing():
    assert band(10.0, [10.0, 10.0, 10.0], 0.0, 2).half_width > 0.0
    assert band_of_smallest(10.0, [10.0, 10.0], 0.0, 2).half_width > 0.0


def found_by(order, last):
    """Films of three grids whose differences fall by the order to the `last` one."""
    return [10.0, 10.0 - last, 10.0 - last - last * 2.0**order]


@pytest.mark.parametrize("order, believed", [(0.5, 1.0), (1.0, 1.0), (1.5, 1.5), (2.0, 2.0), (2.5, 2.0)])
def test_of_the_smallest_gap_a_low_observed_order_makes_the_error_larger(order, believed):
    """Shear that thins the oil left 1.2 of 2 about line contacts, whose bands were too narrow."""
    last = 0.1
    found = band_of_smallest(10.0, found_by(order, last), 0.0, 2)
    assert found.observed_order == pytest.approx(order)
    assert found.half_width == pytest.approx(last / (2.0**believed - 1.0))
    by_chance = band_of_smallest(10.0, found_by(order, last), 2.0 * last, 2).half_width
    assert by_chance == pytest.approx(last / 3.0 + SPREADS * 2.0 * last / 3.0)


def test_the_safety_of_the_smallest_gap_is_the_spread_of_the_difference():
    """Errors of 0.4, of second order, that differ by 0.3 from node to node."""
    films = values(30.0, 2, 0.4, 3)
    like, unlike = (band_of_smallest(films[0], films, 0.9, 2, each) for each in (False, True))
    assert like.half_width == pytest.approx(0.4 + SPREADS * 0.3) and unlike.half_width > like.half_width
    assert like.observed_order == pytest.approx(2.0)


def test_films_by_a_better_scheme_tell_the_limit_and_how_far_that_is_from_them():
    """Of second order, with errors of 0.3 and 1.2: the limit is 30, and 0.5 from the film."""
    assert band_beside(30.5, [30.3, 31.2], 2).half_width == pytest.approx(0.5 + 0.3)
    assert band_beside(30.5, [30.3], 2).half_width == pytest.approx(0.2)
