"""The order of a Couette scheme from its table."""

import pytest

from mgehl.discretization.couette import SCHEMES, couette_scheme
from mgehl.discretization.order import _difference, couette_order

ORDERS = {"1B": 1, "2B": 2, "2C": 2, "S1B": 1, "S2C": 2, "S2B-v": 2, "S2B-vi": 2, "3B": 3, "3L": 3}


@pytest.mark.parametrize("name", SCHEMES)
def test_order_is_that_of_the_literature(name):
    assert couette_order(name) == ORDERS[name]


@pytest.mark.parametrize("name, error", [("1B", -1.0), ("2B", 0.0)])
def test_the_difference_of_a_square_is_off_by_what_upwinding_smears(name, error):
    """d(x^2)/dx = 0 at 0; from the west (0 - 1)/1 = -1."""
    assert _difference(couette_scheme(name), 2, 0) == pytest.approx(error)
    assert _difference(couette_scheme(name), 0, 2) == pytest.approx(error)


def test_a_constant_has_no_difference():
    assert _difference(couette_scheme("2B"), 0, 0) == 0.0
