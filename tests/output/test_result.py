"""The record of a run and its verdict."""

import numpy as np
import pytest

from mgehl.discretization.status import BOUNDARY, CONTACT, LUBRICATED
from mgehl.output.result import Work
from mgehl.output.summary import summarise
from mgehl.solver.outcome import Cycle, Outcome
from mgehl.solver.partition import Changes
from mgehl.solver.problem import State


@pytest.fixture
def outcome(tiny_problem):
    """A film without pressure and with a parallel gap, said to be converged."""
    shape = tiny_problem.grid.shape
    status = np.where(tiny_problem.boundary, BOUNDARY, LUBRICATED).astype(np.int8)
    state = State(np.zeros(shape), 0.0, np.full(shape, 0.5), status)
    last = Cycle(3, 1e-9, -2e-10, 0.5, 0.5, 0, 0, Changes())
    return Outcome(state, True, "settled", [last])


@pytest.fixture
def summary(tiny_problem, outcome, monkeypatch):
    """The record of `outcome`, whose state is taken as it is and called a good one."""

    def make(residual=1e-9, load=-2e-10):
        monkeypatch.setattr(tiny_problem, "state", lambda *_: outcome.state)
        monkeypatch.setattr(tiny_problem, "residual", lambda _, status: np.full(status.shape, residual))
        monkeypatch.setattr(tiny_problem, "load_deficit", lambda P: load)
        monkeypatch.setattr("mgehl.output.summary._conserves", lambda *_: True)
        return summarise(tiny_problem, outcome, 1e-8, Work(12.5, 7), 3.0, {"mgehl": "0"})

    return make


@pytest.mark.parametrize("wrong", [{"residual": 2e-8}, {"load": -2e-8}, {"residual": np.nan}])
def test_a_final_state_beyond_the_tolerance_is_not_converged_whatever_newton_said(summary, wrong):
    result = summary(**wrong)
    assert not result.converged
    assert next(iter(wrong)) in result.reason


def test_gap_residual_and_load_are_evaluated_anew(tiny_problem, outcome):
    result = summarise(tiny_problem, outcome, 1e-8, Work(12.5, 7), 3.0, {})
    state = tiny_problem.state(outcome.state.P, 0.0, outcome.state.status)
    assert result.residual == tiny_problem.rms(
        tiny_problem.residual(tiny_problem.evaluate(state), state.status)
    )
    assert result.load_error == tiny_problem.load_deficit(state.P)
    assert not result.converged


def touch(state, nodes):
    """Put nodes in contact under the pressure 0.5."""
    for j, i in nodes:
        state.status[j, i], state.P[j, i], state.H[j, i] = CONTACT, 0.5, 0.0


def test_a_violation_of_eq_2_is_not_converged(summary, outcome):
    """Contact under 0.5 amid fluid of 0.75: with all errors it is 0.734375 at the interface at the most."""
    outcome.state.P[1:-1, 1:-1], outcome.state.H[:] = 0.75, 0.0
    touch(outcome.state, [(4, 5)])
    result = summary()
    assert not result.converged
    assert "1 of 1" in result.reason
    at_interface, at_nodes = result.pressure_inequality, result.other_inequality
    assert (at_interface.checked, at_interface.violations, at_interface.worst) == (1, 1, 0.015625)
    assert at_interface.nodes == [{"i": 6, "j": 5, "size": 0.015625}]
    assert (at_nodes.checked, at_nodes.violations, at_nodes.worst) == (1, 1, 0.25)


def test_broken_complementarity_is_not_converged(summary, outcome):
    outcome.state.P[4, 4] = -1e-3
    result = summary()
    assert not result.converged
    assert "complementarity" in result.reason
    assert result.complementarity_error == pytest.approx(1e-3)
