"""When a solve ends, and why."""

from dataclasses import replace

import numpy as np
import pytest

from mgehl.discretization.status import BOUNDARY, LUBRICATED
from mgehl.solver.judge import (
    IDLE_CIRCLE,
    IDLE_STUCK,
    goes_in_a_circle,
    is_stuck,
    judge,
    steps_since_lowered,
)
from mgehl.solver.outcome import Cycle
from mgehl.solver.partition import RESTLESS, Changes, Partition
from mgehl.solver.position import Position
from mgehl.solver.problem import State
from mgehl.solver.recipe import IDLE as IDLE_STEPS
from mgehl.solver.settings import NewtonSettings

TOLERANCE = 1e-8
LIMITS = NewtonSettings(TOLERANCE, max_steps=20, idle_steps=IDLE_STEPS)


@pytest.fixture
def partition(tiny_problem):
    return Partition(tiny_problem, 0)


@pytest.fixture
def make_position(tiny_problem, partition):
    """Factory of the position of a film whose cycles have these residuals, the last one these changes."""

    def make(*residuals, changes=None):
        status = np.where(tiny_problem.boundary, BOUNDARY, LUBRICATED).astype(np.int8)
        state = State(np.zeros(status.shape), 0.0, np.ones(status.shape), status)
        cycles = [Cycle(7, each, 0.0, 1.0, 1.0, 0, 0, changes or Changes()) for each in residuals]
        return Position(state, partition.past, cycles)

    return make


def test_residual_load_and_sets_must_all_be_settled(partition, make_position):
    assert judge(make_position(TOLERANCE), partition, LIMITS).converged
    unsettled = make_position(2.0 * TOLERANCE), make_position(0.0, changes=Changes(filled=1))
    assert not any(judge(each, partition, LIMITS).ends for each in unsettled)


def test_sets_that_cycle_name_their_nodes(partition, make_position):
    partition.past.turns[4, 4], partition.past.torn_pressure[4, 4] = RESTLESS, -0.2
    found = judge(make_position(1e-3), partition, LIMITS)
    assert found.ends and not found.converged and "the sets cycle after 7 steps" in found.reason
    assert [(each.i, each.j, each.pressure) for each in found.contradictions] == [(5, 5, -0.2)]


def test_many_steps_that_gain_nothing_are_stuck_though_one_wins_back_what_another_lost(make_position):
    """Of a film; where contact closes continuously they are usual."""
    residuals = [1.0, 12.0, 10.0, 8.0, 6.0, 5.0]
    for steps in (IDLE_STUCK, IDLE_STUCK + 1):
        position = make_position(*residuals[:steps])
        assert not is_stuck(position, True)
        assert is_stuck(position, False) == (steps > IDLE_STUCK)


@pytest.mark.parametrize("by_film", [True, False])
def test_sets_are_taken_for_a_circle_after_some_steps_in_vain(make_position, by_film):
    """Where contact closes continuously."""
    position = make_position()
    for steps in (IDLE_CIRCLE, IDLE_CIRCLE + 1):
        residuals = [1.0, 12.0, 0.95, 8.0, 6.0, 5.0, 4.0, 3.0, 2.0][:steps]
        position.cycles[:] = [make_position(each).cycles[0] for each in residuals]
        assert goes_in_a_circle(position, by_film) == (by_film and steps > IDLE_CIRCLE)


class TestIdleSteps:
    """A residual that does not fall any more ends a solve before the last of the steps that it may take."""

    def test_a_film_that_the_grid_does_not_hold_is_given_up(self, paper_contact, solve):
        """For what reason is decided by rounding."""
        ended = solve(paper_contact(0.012), 65).outcome
        assert not ended.converged and ended.cycles[-1].step < NewtonSettings().max_steps / 2

    def test_a_film_that_can_be_solved_no_further_is_given_up(self, paper_contact, solve):
        """Rounding ends the fall of the residual at some 1e-12."""
        ended = solve(paper_contact(1.0), 65, newton={"tolerance": 1e-30}).outcome
        assert not ended.converged and "did not lower it" in ended.reason
        assert steps_since_lowered(ended) == IDLE_STEPS and ended.cycles[-1].step < 60

    def test_a_user_may_have_more_or_less_patience(self, paper_contact, solve):
        ended = solve(paper_contact(1.0), 65, newton={"tolerance": 1e-30, "idle_steps": 3}).outcome
        assert ended.reason.endswith("the last 3 did not lower it")


def test_a_step_in_time_need_not_wait_for_sets_that_no_residual_tells_apart(partition, make_position):
    """By the settings of a steady solve the same position goes on."""
    position = make_position(0.1 * TOLERANCE, changes=Changes(entered=1))
    assert judge(position, partition, replace(LIMITS, certain=TOLERANCE)).converged
    assert not judge(position, partition, LIMITS).ends
