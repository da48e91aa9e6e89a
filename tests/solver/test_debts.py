"""Contents of less than nothing are paid for by the nodes around."""

import numpy as np
import pytest

from mgehl.solver.debts import paid


@pytest.fixture
def contents(tiny_problem):
    """Of every node, some of a random third of which is owed."""
    chance = np.random.default_rng(3)
    m = chance.random(tiny_problem.grid.shape) + 0.1
    return np.where(chance.random(m.shape) < 0.05, -0.3 * m, m)


def test_nothing_is_made_and_nothing_is_owed(tiny_problem, contents):
    inner = ~tiny_problem.boundary
    found = paid(tiny_problem, contents)
    assert np.any(contents[inner] < 0.0)
    assert np.all(found[inner] > -1e-15)
    assert found[inner].sum() == pytest.approx(contents[inner].sum(), rel=1e-14)
    assert np.array_equal(found[~inner], contents[~inner])


def test_a_debt_is_paid_by_the_four_around_it_as_they_hold(tiny_problem):
    m = np.ones(tiny_problem.grid.shape)
    m[3, 3], m[3, 4] = -0.1, 2.0
    found = paid(tiny_problem, m)
    assert found[3, 3] == pytest.approx(0.0, abs=1e-16)
    assert found[3, 4] == pytest.approx(2.0 - 0.1 * 2.0 / 5.0)
    assert found[2, 3] == found[4, 3] == found[3, 2] == pytest.approx(1.0 - 0.1 / 5.0)
    assert np.count_nonzero(found != m) == 5
