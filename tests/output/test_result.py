import numpy as np
import pytest

from mgehl.discretization.status import BOUNDARY, CONTACT, LUBRICATED
from mgehl.output.result import Making, Work
from mgehl.output.summary import summarise
from mgehl.solver.outcome import Cycle, Outcome
from mgehl.solver.partition import Changes
from mgehl.solver.problem import State


@pytest.fixture
def outcome(tiny_problem):
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
        monkeypatch.setattr(tiny_problem, "load_deficit", lambda P, H0: load)
        monkeypatch.setattr("mgehl.output.summary._conserves", lambda *_: True)
        return summarise(tiny_problem, outcome, 1e-8, Making(Work(12.5, 7), 3.0, {"mgehl": "0"}))

    return make


@pytest.mark.parametrize("wrong", [{"residual": 2e-8}, {"load": -2e-8}, {"residual": np.nan}])
def test_a_final_state_beyond_the_tolerance_is_not_converged_whatever_newton_said(summary, wrong):
    result = summary(**wrong)
    assert not result.converged
    assert next(iter(wrong)) in result.reason


def touch(state, nodes):
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


def test_a_pressure_that_falls_through_the_contact_breaks_eq_2_between_nodes_alone(summary, outcome):
    outcome.state.P[2:-2, 2:-2] = np.linspace(0.7, 0.3, 5)
    touch(outcome.state, [(4, 4)])
    result = summary()
    assert result.converged and result.pressure_inequality.violations == 0
    assert (result.other_inequality.violations, result.other_inequality.checked) == (1, 1)


def test_broken_complementarity_is_not_converged(summary, outcome):
    outcome.state.P[4, 4] = -1e-3
    result = summary()
    assert not result.converged
    assert "complementarity" in result.reason
    assert result.complementarity_error == pytest.approx(1e-3)


def test_contact_is_described_with_nodes_counted_from_one(summary, outcome, tiny_problem):
    mesh = tiny_problem.grid.mesh
    i, j = mesh.centre
    assert (i, j) == (5, 4)
    touch(outcome.state, [(j, i), (j, i - 1), (j - 1, i), (j + 1, i), (j + 2, i)])
    outcome.state.H[j, i] = -1e-9
    result = summary()
    contact = result.contact
    assert contact.nodes == 5
    assert contact.x_nodes == (i, i + 1)
    assert contact.y_nodes == (j, j + 3)
    assert contact.area_fraction == pytest.approx(5 * mesh.dX * mesh.dY / np.pi)
    nm = 1e9 * tiny_problem.contact.film_scale
    assert contact.largest_gap_nm == pytest.approx(1e-9 * nm)
    assert result.overlap.nodes == 0
    assert result.max_pressure_GPa == pytest.approx(0.5e-9 * tiny_problem.contact.hertz.p_h)
