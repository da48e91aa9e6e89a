"""Fits of the load that peaks carry."""

from math import exp

import pytest

from mgehl.model.load_share import aihara, error_function, zhou_hoeprich


@pytest.mark.parametrize("fit", [aihara, zhou_hoeprich, error_function])
def test_all_of_the_load_without_a_film_and_less_with_every_bit_of_it(fit):
    parts = [fit(ratio) for ratio in (0.0, 0.1, 0.5, 1.0, 3.0)]
    assert parts[0] == 1.0 and parts == sorted(parts, reverse=True) and 0.0 < parts[-1] < 0.01


def test_spot_values():
    assert aihara(1.0) == pytest.approx(exp(-1.8))
    assert zhou_hoeprich(1.0) == pytest.approx(exp(-2.32))
    assert error_function(1.0) == pytest.approx(0.157299207, rel=1e-8)  # tables of erfc
    assert aihara(2.0) == pytest.approx(exp(-1.8 * 2.0**1.2))
    assert zhou_hoeprich(2.0) == pytest.approx(exp(-2.32 * 2.0**0.97))
