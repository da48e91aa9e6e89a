"""Rates of implicit time steps."""

from dataclasses import replace

import numpy as np
import pytest

from mgehl.discretization.fluid import FACE_MEANS
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.solver.problem import State
from mgehl.solver.settings import NewtonSettings
from mgehl.solver.squeeze import FOLDING, OF_NODES, SQUEEZE, STABLE, THINNEST, squeeze_rates

OF_EACH = OF_NODES["arithmetic"]
SETTINGS = NewtonSettings(squeeze=3.0, film_threshold=1e-6)


@pytest.fixture
def state_and_residual(tiny_problem):
    """Any gaps and residuals; no pressure."""
    rng = np.random.default_rng(7)
    shape = tiny_problem.grid.shape
    H = 10.0 ** rng.uniform(-12.0, 0.0, shape)
    return State(np.zeros(shape), 0.0, H, np.full(shape, LUBRICATED)), rng.normal(size=shape)


def test_without_squeeze_there_is_none(tiny_problem, state_and_residual):
    assert squeeze_rates(tiny_problem, *state_and_residual, NewtonSettings()) == 0.0


def test_all_nodes_share_one_and_each_has_its_own(tiny_problem, state_and_residual):
    state, F = state_and_residual
    shared = np.sqrt(np.mean(F**2)) / tiny_problem.grid.mesh.dX
    expected = 3.0 * (shared + OF_EACH * abs(F) / np.maximum(state.H, 1e-6))
    np.testing.assert_allclose(squeeze_rates(tiny_problem, state, F, SETTINGS), expected, rtol=1e-12)


def test_a_film_changes_by_a_few_of_its_heights_at_the_most(tiny_problem, state_and_residual):
    """What flows in during a time step is |F|/rate."""
    state, F = state_and_residual
    rates = squeeze_rates(tiny_problem, state, F, SETTINGS)
    assert (abs(F) / rates <= np.maximum(state.H, 1e-6) / (3.0 * OF_EACH)).all()


def test_a_closed_gap_has_a_finite_rate(tiny_problem, state_and_residual):
    state, F = state_and_residual
    closed = replace(state, H=np.zeros_like(F))
    rates = squeeze_rates(tiny_problem, closed, F, replace(SETTINGS, film_threshold=-np.inf))
    assert np.isfinite(rates).all() and rates.max() <= 3.0 * abs(F).max() * (OF_EACH / THINNEST + 1e3)


def test_rates_vanish_with_the_residual(tiny_problem, state_and_residual):
    state, F = state_and_residual
    smaller = squeeze_rates(tiny_problem, state, 1e-6 * F, SETTINGS)
    np.testing.assert_allclose(smaller, 1e-6 * squeeze_rates(tiny_problem, state, F, SETTINGS), rtol=1e-12)


def test_contact_starts_and_continuation_have_at_least_theirs():
    assert NewtonSettings().squeezed().squeeze == SQUEEZE
    assert NewtonSettings(squeeze=7.0).squeezed().squeeze == 7.0


def test_every_mean_of_the_mobility_has_its_part():
    """The harmonic one's is the largest: its flow falls again soonest."""
    assert set(OF_NODES) == set(FACE_MEANS) and max(OF_NODES, key=OF_NODES.get) == "harmonic"


class TestFold:
    """A node that its neighbours' lower pressure drains the less, the higher its own is."""

    LINE, NODE = 4, 4
    AT_REST = 1e-300
    """A residual so small that no other rate is left."""

    @pytest.fixture
    def folded(self, make_problem):
        """Function: problem by a mean and a state with one node above its neighbours by `dP`."""

        def make(mean, dP, at_node=LUBRICATED):
            problem = make_problem(nodes=9, scheme=Scheme(face_mobility=mean))
            status = np.full(problem.grid.shape, LUBRICATED)
            status[self.LINE, self.NODE] = at_node
            P = np.full(problem.grid.shape, 0.02)
            P[self.LINE, self.NODE] += dP
            state = problem.state(P, 0.0, status)
            state.H[:] = 0.5
            return problem, state

        return make

    def inflow_by_own_pressure(self, problem, state, rates):
        """d(F - rate H)/dP of the node, by central differences with the gap it lifts."""
        at, d, values = (self.LINE, self.NODE), 1e-7, []
        for sign in (1.0, -1.0):
            P, H = state.P.copy(), state.H.copy()
            P[at] += sign * d
            H[at] += sign * d * problem.K00
            moved = replace(state, P=P, H=H)
            rho = problem.contact.lubricant.density_law.density(P, problem.contact.pressure_scale)[0]
            values.append(problem.inflow(moved)[at] - rates[at] * rho[at] * H[at])
        return (values[0] - values[1]) / (2.0 * d)

    @pytest.mark.parametrize("mean", FOLDING)
    @pytest.mark.parametrize("rms", [1e-2, AT_REST])
    def test_beyond_its_fold_a_node_is_stable_by_itself(self, folded, mean, rms):
        problem, state = folded(mean, 0.2)
        F = np.full(problem.grid.shape, rms)
        rates = squeeze_rates(problem, state, F, SETTINGS)
        assert self.inflow_by_own_pressure(problem, state, np.zeros_like(F)) > 0.0
        assert self.inflow_by_own_pressure(problem, state, rates) <= 1e-6

    @pytest.mark.parametrize("mean", FOLDING)
    def test_far_from_one_the_last_steps_are_newton_s(self, folded, mean):
        problem, state = folded(mean, 0.0)
        F = np.full(problem.grid.shape, self.AT_REST)
        assert squeeze_rates(problem, state, F, SETTINGS)[self.LINE, self.NODE] < 1e-200

    def test_the_margin_fades_with_the_residual(self, folded):
        problem, state = folded("harmonic", 0.2)
        quiet = NewtonSettings(squeeze=1e-300, film_threshold=1e-6)
        rates = [
            squeeze_rates(problem, state, np.full(problem.grid.shape, rms), quiet)[self.LINE, self.NODE]
            for rms in (1e-3, 1e-6, 5e-7, self.AT_REST)
        ]
        margins = (np.array(rates) - rates[-1]) * problem.grid.mesh.dX / STABLE
        np.testing.assert_allclose(margins, [1.0, 1.0, 0.5, 0.0], rtol=1e-9, atol=1e-9)

    def test_the_arithmetic_mean_has_none_and_contact_neither(self, folded):
        for mean, at_node in (("arithmetic", LUBRICATED), ("harmonic", CONTACT)):
            problem, state = folded(mean, 0.2, at_node)
            F = np.full(problem.grid.shape, self.AT_REST)
            assert squeeze_rates(problem, state, F, SETTINGS)[self.LINE, self.NODE] < 1e-200

    def test_a_node_beside_contact_has_none(self, folded):
        """Contact holds it down."""
        problem, state = folded("harmonic", 0.2)
        F = np.full(problem.grid.shape, self.AT_REST)
        assert squeeze_rates(problem, state, F, SETTINGS)[self.LINE, self.NODE] > 0.1
        for line, node in ((0, 1), (0, -1), (1, 0), (-1, 0)):
            touched = replace(state, status=state.status.copy())
            touched.status[self.LINE + line, self.NODE + node] = CONTACT
            assert squeeze_rates(problem, touched, F, SETTINGS)[self.LINE, self.NODE] < 1e-200
