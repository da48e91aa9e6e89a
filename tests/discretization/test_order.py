"""The order of a Couette scheme from its table."""

import pytest

from mgehl.discretization.couette import SCHEMES
from mgehl.discretization.order import couette_order

ORDERS = {"1B": 1, "2B": 2, "2C": 2, "S1B": 1, "S2C": 2, "S2B-v": 2, "S2B-vi": 2, "3B": 3, "3L": 3}


@pytest.mark.parametrize("name", SCHEMES)
def test_order_is_that_of_the_literature(name):
    assert couette_order(name) == ORDERS[name]
