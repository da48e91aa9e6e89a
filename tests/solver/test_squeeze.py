"""Rates of implicit time steps."""

from dataclasses import replace

import numpy as np
import pytest

from mgehl.discretization.fluid import FACE_MEANS
from mgehl.solver.settings import NewtonSettings
from mgehl.solver.squeeze import OF_NODES, SQUEEZE, THINNEST, squeeze_rates

OF_EACH = OF_NODES["arithmetic"]
SETTINGS = NewtonSettings(squeeze=3.0, film_threshold=1e-6)


@pytest.fixture
def gap_and_residual(tiny_problem):
    rng = np.random.default_rng(7)
    shape = tiny_problem.grid.shape
    return 10.0 ** rng.uniform(-12.0, 0.0, shape), rng.normal(size=shape)


def test_without_squeeze_there_is_none(tiny_problem, gap_and_residual):
    assert squeeze_rates(tiny_problem, *gap_and_residual, NewtonSettings()) == 0.0


def test_all_nodes_share_one_and_each_has_its_own(tiny_problem, gap_and_residual):
    H, F = gap_and_residual
    shared = np.sqrt(np.mean(F**2)) / tiny_problem.grid.mesh.dX
    expected = 3.0 * (shared + OF_EACH * abs(F) / np.maximum(H, 1e-6))
    np.testing.assert_allclose(squeeze_rates(tiny_problem, H, F, SETTINGS), expected, rtol=1e-12)


def test_a_film_changes_by_a_few_of_its_heights_at_the_most(tiny_problem, gap_and_residual):
    """What flows in during a time step is |F|/rate."""
    H, F = gap_and_residual
    rates = squeeze_rates(tiny_problem, H, F, SETTINGS)
    assert (abs(F) / rates <= np.maximum(H, 1e-6) / (3.0 * OF_EACH)).all()


def test_a_closed_gap_has_a_finite_rate(tiny_problem, gap_and_residual):
    _, F = gap_and_residual
    rates = squeeze_rates(tiny_problem, np.zeros_like(F), F, replace(SETTINGS, film_threshold=-np.inf))
    assert np.isfinite(rates).all() and rates.max() <= 3.0 * abs(F).max() * (OF_EACH / THINNEST + 1e3)


def test_rates_vanish_with_the_residual(tiny_problem, gap_and_residual):
    H, F = gap_and_residual
    smaller = squeeze_rates(tiny_problem, H, 1e-6 * F, SETTINGS)
    np.testing.assert_allclose(smaller, 1e-6 * squeeze_rates(tiny_problem, H, F, SETTINGS), rtol=1e-12)


def test_contact_starts_and_continuation_have_at_least_theirs():
    assert NewtonSettings().squeezed().squeeze == SQUEEZE
    assert NewtonSettings(squeeze=7.0).squeezed().squeeze == 7.0


def test_every_mean_of_the_mobility_has_its_part(tiny_problem, gap_and_residual):
    """The harmonic one's is the largest: its flow falls again soonest."""
    assert set(OF_NODES) == set(FACE_MEANS) and max(OF_NODES, key=OF_NODES.get) == "harmonic"
    H, F = gap_and_residual
    paper = squeeze_rates(tiny_problem, H, F, SETTINGS)
    tiny_problem.scheme = replace(tiny_problem.scheme, face_mobility="harmonic")
    more = 3.0 * (OF_NODES["harmonic"] - OF_EACH) * abs(F) / np.maximum(H, 1e-6)
    np.testing.assert_allclose(squeeze_rates(tiny_problem, H, F, SETTINGS), paper + more, rtol=1e-12)
