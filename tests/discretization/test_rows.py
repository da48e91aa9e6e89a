import numpy as np
import pytest

from mgehl.discretization.rows import FLOW, GAP, PRESSURE, rows_of
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED

EVERY = np.array([[BOUNDARY, LUBRICATED, CAVITATED, CONTACT]])


@pytest.mark.parametrize("rigid, contact", [(False, GAP), (True, PRESSURE)], ids=["elastic", "rigid"])
def test_the_status_says_which(rigid, contact):
    assert rows_of(EVERY, rigid).tolist() == [[PRESSURE, FLOW, PRESSURE, contact]]
