"""Rates of implicit time steps."""

from dataclasses import replace

import numpy as np
import pytest

from mgehl.discretization.contact_law import InterfaceConditions, UnifiedEquations
from mgehl.discretization.fluid import FACE_MOBILITIES, FOLDING
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.solver.problem import State
from mgehl.solver.settings import NewtonSettings
from mgehl.solver.squeeze import OF_NODES, SQUEEZE, STABLE, squeeze_rates

THIN = InterfaceConditions(1e-6)
SETTINGS = NewtonSettings(squeeze=3.0)


def rates_of(problem, state, F, settings=SETTINGS):
    return squeeze_rates(problem, problem.evaluate(state), problem.rows(state.status), F, settings)


@pytest.fixture
def problem(make_problem):
    """9 x 9 nodes, contact below 1e-6."""
    return make_problem(nodes=9, scheme=Scheme(contact_law=THIN))


@pytest.fixture
def state_and_residual(problem):
    """Any gaps and residuals; no pressure."""
    rng = np.random.default_rng(7)
    shape = problem.grid.shape
    H = 10.0 ** rng.uniform(-12.0, 0.0, shape)
    return State(np.zeros(shape), 0.0, H, np.full(shape, LUBRICATED)), rng.normal(size=shape)


def test_without_squeeze_there_is_none(problem, state_and_residual):
    assert rates_of(problem, *state_and_residual, NewtonSettings()) == 0.0


def test_every_node_has_a_rate_and_those_that_are_far_from_balance_a_larger_one(
    problem, state_and_residual
):
    """In films of one height the rates are in the order of the residuals, the least one above zero."""
    state, F = state_and_residual
    rates = rates_of(problem, replace(state, H=np.full_like(F, 0.1)), F)
    assert rates.min() > 0.0
    assert (np.argsort(rates, axis=None) == np.argsort(abs(F), axis=None)).all()


def test_a_film_changes_by_a_few_of_its_heights_at_the_most(problem, state_and_residual):
    """What flows in during a time step is |F|/rate: four heights, however thin the film."""
    state, F = state_and_residual
    assert (abs(F) / rates_of(problem, state, F) <= 4.0 * np.maximum(state.H, THIN.threshold)).all()


@pytest.mark.parametrize("law", [InterfaceConditions(), UnifiedEquations()])
def test_a_closed_gap_has_a_finite_rate(make_problem, state_and_residual, law):
    state, F = state_and_residual
    closed = replace(state, H=np.zeros_like(F))
    problem = make_problem(nodes=9, scheme=Scheme(contact_law=law))
    assert np.isfinite(rates_of(problem, closed, F)).all()


def test_rates_vanish_with_the_residual(problem, state_and_residual):
    state, F = state_and_residual
    smaller = rates_of(problem, state, 1e-6 * F)
    np.testing.assert_allclose(smaller, 1e-6 * rates_of(problem, state, F), rtol=1e-12)


def test_contact_starts_and_continuation_have_at_least_theirs():
    assert NewtonSettings().squeezed().squeeze == SQUEEZE
    assert NewtonSettings(squeeze=7.0).squeezed().squeeze == 7.0


def test_every_mean_of_the_mobility_has_its_part():
    """The harmonic one's is the largest: its flow falls again soonest."""
    assert set(OF_NODES) == set(FACE_MOBILITIES) and max(OF_NODES, key=OF_NODES.get) == "harmonic"


class TestFold:
    """A node that its neighbours' lower pressure drains the less, the higher its own is."""

    LINE, NODE = 4, 4
    AT_REST = 1e-300
    """A residual so small that no other rate is left."""

    @pytest.fixture
    def folded(self, make_problem):
        """Function: problem by a mean and a state with one node above its neighbours by `dP`."""

        def make(mean, dP, at_node=LUBRICATED):
            problem = make_problem(nodes=9, scheme=Scheme(face_mobility=mean, contact_law=THIN))
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
            moved = replace(state, P=P, p=P, H=H)
            rho = problem.contact.lubricant.density_law.density(P, problem.contact.pressure_scale)[0]
            values.append(problem.evaluate(moved).inflow[at] - rates[at] * rho[at] * H[at])
        return (values[0] - values[1]) / (2.0 * d)

    @pytest.mark.parametrize("mean", FOLDING)
    @pytest.mark.parametrize("rms", [1e-2, AT_REST])
    def test_beyond_its_fold_a_node_is_stable_by_itself(self, folded, mean, rms):
        problem, state = folded(mean, 0.2)
        F = np.full(problem.grid.shape, rms)
        rates = rates_of(problem, state, F)
        assert self.inflow_by_own_pressure(problem, state, np.zeros_like(F)) > 0.0
        assert self.inflow_by_own_pressure(problem, state, rates) <= 1e-6

    @pytest.mark.parametrize("mean", FOLDING)
    def test_far_from_one_the_last_steps_are_newton_s(self, folded, mean):
        problem, state = folded(mean, 0.0)
        F = np.full(problem.grid.shape, self.AT_REST)
        assert rates_of(problem, state, F)[self.LINE, self.NODE] < 1e-200

    def test_the_margin_fades_with_the_residual(self, folded):
        problem, state = folded("harmonic", 0.2)
        quiet = NewtonSettings(squeeze=1e-300)
        rates = [
            rates_of(problem, state, np.full(problem.grid.shape, rms), quiet)[self.LINE, self.NODE]
            for rms in (1e-3, 1e-6, 5e-7, self.AT_REST)
        ]
        margins = (np.array(rates) - rates[-1]) * problem.grid.mesh.dX / STABLE
        np.testing.assert_allclose(margins, [1.0, 1.0, 0.5, 0.0], rtol=1e-9, atol=1e-9)

    def test_the_arithmetic_mean_has_none_and_contact_neither(self, folded):
        for mean, at_node in (("arithmetic", LUBRICATED), ("harmonic", CONTACT)):
            problem, state = folded(mean, 0.2, at_node)
            F = np.full(problem.grid.shape, self.AT_REST)
            assert rates_of(problem, state, F)[self.LINE, self.NODE] < 1e-200

    def test_a_node_beside_contact_has_none(self, folded):
        """Contact holds it down."""
        problem, state = folded("harmonic", 0.2)
        F = np.full(problem.grid.shape, self.AT_REST)
        assert rates_of(problem, state, F)[self.LINE, self.NODE] > 0.1
        for line, node in ((0, 1), (0, -1), (1, 0), (-1, 0)):
            touched = replace(state, status=state.status.copy())
            touched.status[self.LINE + line, self.NODE + node] = CONTACT
            assert rates_of(problem, touched, F)[self.LINE, self.NODE] < 1e-200
