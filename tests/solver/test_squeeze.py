"""Rates of implicit time steps."""

from dataclasses import replace

import numpy as np
import pytest

from mgehl.discretization.contact_law import InterfaceConditions
from mgehl.discretization.fluid import FOLDING
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import LUBRICATED
from mgehl.solver.problem import State
from mgehl.solver.settings import NewtonSettings
from mgehl.solver.squeeze import squeeze_rates

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


def test_a_film_changes_by_a_few_of_its_heights_at_the_most(problem, state_and_residual):
    """What flows in during a time step is |F|/rate: four heights, however thin the film."""
    state, F = state_and_residual
    assert (abs(F) / rates_of(problem, state, F) <= 4.0 * np.maximum(state.H, THIN.threshold)).all()


def test_rates_vanish_with_the_residual(problem, state_and_residual):
    state, F = state_and_residual
    smaller = rates_of(problem, state, 1e-6 * F)
    np.testing.assert_allclose(smaller, 1e-6 * rates_of(problem, state, F), rtol=1e-12)


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
