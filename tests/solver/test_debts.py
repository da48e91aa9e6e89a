import numpy as np
import pytest

from mgehl.solver.debts import paid


def test_a_debt_within_wide_contact_is_paid(tiny_problem):
    """No node around holds anything there; what was still owed could not be made up for by any pressure."""
    m = np.ones(tiny_problem.grid.shape)
    middle = tuple(each // 2 for each in m.shape)
    around = tuple(slice(each - 2, each + 3) for each in middle)
    m[around], m[middle] = 0.0, -1e-6
    after = paid(tiny_problem, m)
    assert after.min() >= 0.0
    assert after.sum() == pytest.approx(m.sum(), rel=1e-15)
    assert np.all(after[around] == 0.0)
