"""The verdict on a position; looking at it changes nothing."""

import copy
from dataclasses import replace

import numpy as np
import pytest
from petsc4py import PETSc

from mgehl.discretization.status import BOUNDARY, LUBRICATED
from mgehl.solver.judge import (
    GO_ON,
    IDLE_CIRCLE,
    IDLE_STUCK,
    STALLS,
    STUCK,
    Verdict,
    goes_in_a_circle,
    is_stuck,
    judge,
    judge_system,
    judge_work,
    steps_since_lowered,
)
from mgehl.solver.outcome import Cycle
from mgehl.solver.partition import RESTLESS, Changes, Partition
from mgehl.solver.position import Position, Trial
from mgehl.solver.problem import DIVERGED, State
from mgehl.solver.recipe import IDLE as IDLE_STEPS
from mgehl.solver.settings import NewtonSettings

TOLERANCE, MAX_STEPS = 1e-8, 20
LIMITS = NewtonSettings(TOLERANCE, max_steps=MAX_STEPS, idle_steps=IDLE_STEPS)
REASONS = PETSc.KSP.ConvergedReason


@pytest.fixture
def partition(tiny_problem):
    return Partition(tiny_problem, 0)


@pytest.fixture
def make_position(tiny_problem, partition):
    """Factory of the position of a film whose last cycle is given."""

    def make(residual=1e-3, load_error=0.0, step=7, changes=None, trial_until=None, **fields):
        status = np.where(tiny_problem.boundary, BOUNDARY, LUBRICATED).astype(np.int8)
        state = State(np.zeros(status.shape), 0.0, np.ones(status.shape), status)
        trial = trial_until and Trial(state.copy(), "settled before", 2, 2, trial_until)
        cycle = Cycle(step, residual, load_error, 1.0, 1.0, 0, 0, changes or Changes())
        return Position(state, partition.past, [cycle], trial=trial, **fields)

    return make


@pytest.fixture
def verdict(partition, make_position):
    """Function: the verdict on a position, which must be left as it was."""

    def ask(**fields):
        position = make_position(**fields)
        before = copy.deepcopy(vars(position))
        found = judge(position, partition, LIMITS)
        for name, value in vars(position).items():
            if name not in ("state", "past", "trial"):
                assert value == before[name]
        np.testing.assert_array_equal(position.state.status, before["state"].status)
        np.testing.assert_array_equal(position.past.turns, before["past"].turns)
        return found

    return ask


def test_on_the_way_it_goes_on(verdict):
    assert verdict() is GO_ON and not GO_ON.ends


def test_settled(verdict):
    found = verdict(residual=TOLERANCE, load_error=-TOLERANCE)
    assert found.ends and found.converged and "settled" in found.reason


@pytest.mark.parametrize(
    "missing",
    [{"residual": 2.0 * TOLERANCE}, {"load_error": -2.0 * TOLERANCE}, {"changes": Changes(filled=1)}],
    ids=["residual", "load", "sets"],
)
def test_all_three_must_be(verdict, missing):
    assert verdict(**({"residual": 0.0, "load_error": 0.0} | missing)) is GO_ON


@pytest.mark.parametrize("residual", [DIVERGED, np.inf, np.nan])
def test_no_way_back(verdict, residual):
    found = verdict(residual=residual)
    assert found.ends and not found.converged
    assert found.reason.startswith("diverged") and found.reason.endswith("after 7 steps")


@pytest.mark.parametrize("until, ends", [(None, False), (7, True), (8, False)])
def test_a_trial_has_its_own_last_step(verdict, until, ends):
    assert verdict(trial_until=until).ends == ends


@pytest.mark.parametrize(
    "fields, said",
    [({}, "residual 1.0e-03"), ({"residual": 0.0, "changes": Changes(entered=1)}, "sets still change")],
)
def test_the_last_step_says_what_was_left(verdict, fields, said):
    found = verdict(step=MAX_STEPS, **fields)
    assert found.ends and not found.converged
    assert found.reason.startswith(said) and found.reason.endswith(f"after {MAX_STEPS} steps")


def test_a_settled_state_is_settled_at_the_last_step_too(verdict):
    assert verdict(residual=0.0, step=MAX_STEPS).converged


def test_linear_systems_that_stay_unsolved(verdict):
    assert verdict(stalls=STALLS - 1) is GO_ON
    found = verdict(stalls=STALLS)
    assert found.ends and not found.converged and "could not be solved" in found.reason


def test_sets_that_cycle_name_their_nodes(verdict, partition):
    partition.past.turns[4, 4], partition.past.torn_pressure[4, 4] = RESTLESS, -0.2
    found = verdict()
    assert found.ends and not found.converged and "the sets cycle after 7 steps" in found.reason
    assert [(each.i, each.j, each.pressure) for each in found.contradictions] == [(5, 5, -0.2)]


class TestSystem:
    """A linear system that was solved, or not."""

    @pytest.mark.parametrize("reason", [REASONS.CONVERGED_RTOL, REASONS.DIVERGED_MAX_IT])
    def test_it_goes_on_with_what_it_got(self, make_position, reason):
        assert judge_system(reason, make_position()) is GO_ON

    def test_a_singular_one_ends_it(self, make_position):
        found = judge_system(REASONS.DIVERGED_NANORINF, make_position())
        assert found.ends and not found.converged and found.reason.startswith("singular")

    @pytest.mark.parametrize("reason", [REASONS.DIVERGED_MAX_IT, REASONS.DIVERGED_NANORINF])
    def test_a_trial_has_no_patience(self, make_position, reason):
        found = judge_system(reason, make_position(trial_until=15))
        assert found.ends and not found.converged
        assert judge_system(REASONS.CONVERGED_RTOL, make_position(trial_until=15)) is GO_ON


@pytest.mark.parametrize(
    "residuals, stuck",
    [
        ([1.0, 0.99, 0.98], True),
        ([1.0, 1.2, 0.95], True),
        ([1.0, 0.99], False),
        ([1.0, 0.99, 0.5], False),
        ([1.0, 0.5, 0.99], False),
        ([9.0, 1.0, 0.99, STUCK], False),
    ],
)
def test_two_steps_that_gain_nothing_are_stuck(make_position, residuals, stuck):
    position = make_position()
    position.cycles[:] = [make_position(residual).cycles[0] for residual in residuals]
    assert is_stuck(position, False) == stuck


def test_many_steps_that_gain_nothing_are_stuck_though_one_wins_back_what_another_lost(make_position):
    """Of a film; where contact closes continuously they are usual."""
    position = make_position()
    residuals = [1.0, 12.0, 10.0, 8.0, 6.0, 5.0]
    for steps in (IDLE_STUCK, IDLE_STUCK + 1):
        position.cycles[:] = [make_position(each).cycles[0] for each in residuals[:steps]]
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


class TestWork:
    """A run may make so many convolutions."""

    @pytest.mark.parametrize("work, ends", [(99.9, False), (100.0, True), (250.4, True)])
    def test_too_much_of_it_ends_what_would_go_on(self, work, ends):
        found = judge_work(GO_ON, work, 100)
        assert found.ends is ends and not found.converged
        assert found.reason == (f"{work:.0f} convolutions led to no answer (solver.max_work = 100)" * ends)

    @pytest.mark.parametrize("ended", [Verdict(True, True, "settled"), Verdict(True, reason="diverged")])
    def test_what_has_ended_stays_as_it_is(self, ended):
        assert judge_work(ended, 1e9, 100) is ended


class TestIdleSteps:
    """A residual that does not fall any more ends a solve before the last of the steps that it may take."""

    @pytest.fixture
    def idle(self, make_position, partition):
        """Function: the verdict after a history of residuals."""

        def ask(residuals, **fields):
            position = make_position(step=10, **fields)
            (last,) = position.cycles
            position.cycles = [replace(last, residual=each) for each in residuals]
            return judge(position, partition, LIMITS)

        return ask

    def test_it_is_said_that_they_led_nowhere(self, idle):
        stays = [1.0, *IDLE_STEPS * [0.95]]
        assert idle(stays[:-1]) is GO_ON
        found = idle(stays)
        assert found.ends and not found.converged
        assert found.reason == f"residual 9.5e-01 after 10 steps: the last {IDLE_STEPS} did not lower it"

    def test_one_that_falls_slowly_goes_on(self, idle):
        assert idle([0.98**k for k in range(40)]) is GO_ON

    def test_one_that_rises_and_comes_back_is_idle(self, idle):
        assert idle([1.0, 0.1, *[0.2 + 0.1 * (-1) ** k for k in range(IDLE_STEPS)]]).ends

    def test_a_small_residual_may_wait_for_its_sets(self, idle):
        assert idle((IDLE_STEPS + 3) * [TOLERANCE], changes=Changes(filled=1)) is GO_ON

    def test_a_trial_of_eq_2_has_a_limit_of_its_own(self, idle):
        assert idle([0.1 * TOLERANCE, *IDLE_STEPS * [0.5]], trial_until=14) is GO_ON

    def test_they_are_counted_from_the_last_lower_one(self, make_position):
        position = make_position()
        (last,) = position.cycles
        position.cycles = [replace(last, residual=each) for each in (1.0, 0.5, 0.48, 0.6, 0.44, 0.44)]
        assert steps_since_lowered(position) == 1

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


class TestSpreadingContact:
    """A solve that is of use only as a film may end as soon as contact spreads and spreads."""

    @pytest.fixture
    def spreading(self, make_position, partition):
        """Function: the verdict after a history of contact nodes."""

        def ask(nodes, steps=3):
            position = make_position(step=len(nodes) - 1)
            (last,) = position.cycles
            position.cycles = [replace(last, contact_nodes=each) for each in nodes]
            return judge(position, partition, replace(LIMITS, spreading_steps=steps))

        return ask

    def test_it_is_given_up_after_so_many_steps(self, spreading):
        assert spreading([4, 8, 12]) is GO_ON
        found = spreading([4, 8, 12, 18])
        assert found.ends and not found.converged
        assert found.reason == "contact spreads, to 18 nodes in 3 steps"

    def test_steps_between_them_in_which_it_does_not_are_not_counted(self, spreading):
        assert spreading([4, 8, 8, 12, 10]) is GO_ON
        assert spreading([4, 8, 8, 12, 10, 11]).ends

    def test_elsewhere_it_may_spread_for_ever(self, spreading):
        assert spreading(list(range(10)), steps=None) is GO_ON


def test_a_step_in_time_need_not_wait_for_sets_that_no_residual_tells_apart(partition, make_position):
    """By the settings of a steady solve the same position goes on."""
    position = make_position(residual=0.1 * TOLERANCE, changes=Changes(entered=1))
    assert judge(position, partition, replace(LIMITS, certain=TOLERANCE)).converged
    assert not judge(position, partition, LIMITS).ends
