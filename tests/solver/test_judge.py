"""The verdict on a position: how a solve ends, and why."""

from dataclasses import replace

import numpy as np
import pytest

from mgehl.discretization.status import BOUNDARY, LUBRICATED
from mgehl.solver.judge import GO_ON, IDLE_STEPS, STALLS, Limits, Verdict, judge, judge_work
from mgehl.solver.outcome import Cycle
from mgehl.solver.partition import RESTLESS, Changes, Partition
from mgehl.solver.position import Position, Trial
from mgehl.solver.problem import DIVERGED, State
from mgehl.solver.settings import NewtonSettings

TOLERANCE, MAX_STEPS = 1e-8, 20
LIMITS = Limits(TOLERANCE, MAX_STEPS, IDLE_STEPS)
SOLVED = {"residual": TOLERANCE, "load_error": -TOLERANCE}


@pytest.fixture
def partition(tiny_problem):
    return Partition(tiny_problem, 0)


@pytest.fixture
def make_position(tiny_problem, partition):
    """Factory of the position of a film whose last cycle is given, or the residuals of all of them."""

    def make(step=7, changes=None, trial_until=None, stalls=0, residual=1e-3, load_error=0.0, residuals=()):
        status = np.where(tiny_problem.boundary, BOUNDARY, LUBRICATED).astype(np.int8)
        state = State(np.zeros(status.shape), 0.0, np.ones(status.shape), status)
        trial = trial_until and Trial(state.copy(), "settled before", 2, 2, trial_until)
        last = Cycle(step, residual, load_error, 1.0, 1.0, 0, 0, changes or Changes())
        cycles = [replace(last, residual=each) for each in residuals or [residual]]
        return Position(state, partition.past, cycles, trial=trial, stalls=stalls)

    return make


IDLE = [1.0, *IDLE_STEPS * [0.95]]
NOT_LOWER = f"residual 9.5e-01 after 7 steps: the last {IDLE_STEPS} did not lower it"
NO_STEPS_LEFT = f"after {MAX_STEPS} steps"
VERDICTS = {
    "on the way": ({}, None),
    "settled": (SOLVED, "residual, load and sets settled"),
    "settled at the last step": (SOLVED | {"step": MAX_STEPS}, "residual, load and sets settled"),
    "residual left": (SOLVED | {"residual": 2.0 * TOLERANCE}, None),
    "load left": (SOLVED | {"load_error": -2.0 * TOLERANCE}, None),
    "sets change": (SOLVED | {"changes": Changes(filled=1)}, None),
    "diverged": ({"residual": DIVERGED}, "diverged"),
    "overflow": ({"residual": np.inf}, "diverged"),
    "no number": ({"residual": np.nan}, "diverged"),
    "steps ran out": ({"step": MAX_STEPS}, "residual 1.0e-03 " + NO_STEPS_LEFT),
    "sets at the end": (SOLVED | {"changes": Changes(entered=1), "step": MAX_STEPS}, "sets still change"),
    "linear systems": ({"stalls": STALLS - 1}, None),
    "unsolved systems": ({"stalls": STALLS}, f"{STALLS} linear systems"),
    "a trial": ({"trial_until": 8}, None),
    "idle": ({"residuals": IDLE}, NOT_LOWER),
    "almost idle": ({"residuals": IDLE[:-1]}, None),
    "slow": ({"residuals": [0.98**k for k in range(40)]}, None),
    "rises, comes back": ({"residuals": [1.0, 0.1, *IDLE_STEPS * [0.2, 0.3]]}, "residual"),
    "waits for its sets": (
        {"residuals": (IDLE_STEPS + 3) * [TOLERANCE], "changes": Changes(filled=1)},
        None,
    ),
    "idle in a trial": ({"residuals": [0.1 * TOLERANCE, *IDLE_STEPS * [0.5]], "trial_until": 14}, None),
}
"""Fields of the position, and how the reason begins where they end the solve."""


@pytest.mark.parametrize("name", VERDICTS)
def test_verdict(make_position, partition, name):
    fields, begins = VERDICTS[name]
    found = judge(make_position(**fields), partition, LIMITS)
    assert found.ends == (begins is not None) and found.converged == name.startswith("settled")
    assert found.reason.startswith(begins or "")


def test_sets_that_cycle_name_their_nodes(make_position, partition):
    partition.past.turns[4, 4], partition.past.torn_pressure[4, 4] = RESTLESS, -0.2
    found = judge(make_position(), partition, LIMITS)
    assert found.ends and not found.converged and "the sets cycle after 7 steps" in found.reason
    assert [(each.i, each.j, each.pressure) for each in found.contradictions] == [(5, 5, -0.2)]


@pytest.mark.parametrize("work, ends", [(99.9, False), (100.0, True), (250.4, True)])
def test_too_much_work_ends_what_would_go_on(work, ends):
    found = judge_work(GO_ON, work, 100)
    assert found.ends is ends and not found.converged
    assert found.reason == (f"{work:.0f} convolutions led to no answer (solver.max_work = 100)" * ends)
    settled = Verdict(True, True, "settled")
    assert judge_work(settled, work, 100) is settled


def test_a_film_that_the_grid_does_not_hold_is_given_up(paper_contact, solve):
    """For what reason is decided by rounding."""
    ended = solve(paper_contact(0.012), 65).outcome
    assert not ended.converged and ended.cycles[-1].step < NewtonSettings().max_steps / 2


def test_a_user_may_have_more_or_less_patience(paper_contact, solve):
    """Rounding ends the fall of the residual at some 1e-12."""
    ended = solve(paper_contact(1.0), 65, newton={"tolerance": 1e-30, "idle_steps": 3}).outcome
    assert not ended.converged and ended.reason.endswith("the last 3 did not lower it")
