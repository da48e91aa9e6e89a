from dataclasses import replace

import numpy as np
import pytest
from petsc4py import PETSc

from mgehl.solver.judge import BACK_AND_FORTH, ROUNDED, STALLS, judge, judge_system, to_and_fro
from mgehl.solver.outcome import Cycle
from mgehl.solver.partition import RESTLESS, Changes, Partition
from mgehl.solver.position import Position
from mgehl.solver.problem import DIVERGED
from mgehl.solver.recipe import IDLE as IDLE_STEPS
from mgehl.solver.settings import NewtonSettings

TOLERANCE = 1e-8
LIMITS = NewtonSettings(TOLERANCE, max_steps=20, idle_steps=IDLE_STEPS)


@pytest.fixture
def partition(tiny_problem):
    return Partition(tiny_problem)


@pytest.fixture
def make_position(state, partition):
    """Factory of the position of a film whose cycles have these residuals, the last one these changes."""

    def make(*residuals, changes=None, load=0.0, step=7, stalls=0, film=1.0):
        cycles = [Cycle(step, each, load, film, film, 0, 0, changes or Changes()) for each in residuals]
        return Position(state.copy(), partition.past, cycles, stalls=stalls)

    return make


FILLED = Changes(filled=1)
IDLE = [1.0, *IDLE_STEPS * [0.95]]
VERDICTS = {
    "settled": ([TOLERANCE], {"load": -TOLERANCE}, "residual, load and sets settled"),
    "settled at the last step": ([TOLERANCE], {"step": 20}, "residual, load and sets settled"),
    "residual": ([2.0 * TOLERANCE], {}, ""),
    "load": ([0.0], {"load": -2.0 * TOLERANCE}, ""),
    "sets": ([0.0], {"changes": FILLED}, ""),
    "diverged": ([DIVERGED], {}, "diverged: residual "),
    "no number": ([np.nan], {}, "diverged: residual nan"),
    "last step": ([1e-3], {"step": 20}, "residual 1.0e-03 after 20 steps"),
    "last step, sets": ([0.0], {"step": 20, "changes": FILLED}, "sets still change after 20 steps"),
    "unsolved": ([1e-3], {"stalls": STALLS}, "3 linear systems in 7 steps could not be solved"),
    "nearly unsolved": ([1e-3], {"stalls": STALLS - 1}, ""),
    "idle": (IDLE, {}, f"residual 9.5e-01 after 7 steps: the last {IDLE_STEPS} did not lower it"),
    "nearly idle": (IDLE[:-1], {}, ""),
    "rounding by a thick film": ((ROUNDED + 1) * [2e-8], {"film": 67.0}, "residual, load and sets settled"),
    "not yet rounding": (ROUNDED * [2e-8], {"film": 67.0}, ""),
    "more than rounding": ((ROUNDED + 1) * [2e-8], {"film": 1.9}, ""),
    "falls slowly": ([0.98**k for k in range(40)], {}, ""),
    "waits for its sets": ((IDLE_STEPS + 3) * [TOLERANCE], {"changes": FILLED}, ""),
}


@pytest.mark.parametrize("residuals, given, reason", VERDICTS.values(), ids=VERDICTS)
def test_the_verdict_on_a_position(partition, make_position, residuals, given, reason):
    found = judge(make_position(*residuals, **given), partition, LIMITS)
    assert found.ends == bool(reason) and found.reason.startswith(reason)
    assert found.converged == reason.endswith("sets settled")


def test_a_singular_linear_system_ends_a_solve_and_one_that_is_not_solved_does_not(make_position):
    reasons, position = PETSc.KSP.ConvergedReason, make_position(1e-3)
    tried = reasons.CONVERGED_RTOL, reasons.DIVERGED_MAX_IT, reasons.DIVERGED_NANORINF
    assert [judge_system(reason, position).ends for reason in tried] == [False, False, True]


def test_sets_that_cycle_name_their_nodes(partition, make_position):
    partition.past.turns[4, 4], partition.past.torn_pressure[4, 4] = RESTLESS, -0.2
    found = judge(make_position(1e-3), partition, LIMITS)
    assert found.ends and not found.converged and "the sets cycle after 7 steps" in found.reason
    assert [(each.i, each.j, each.pressure) for each in found.contradictions] == [(5, 5, -0.2)]


def test_a_step_in_time_need_not_wait_for_sets_that_no_residual_tells_apart(partition, make_position):
    """By the settings of a steady solve the same position goes on."""
    certain = replace(LIMITS, certain=TOLERANCE)
    position = make_position(0.1 * TOLERANCE, changes=Changes(entered=1))
    assert judge(position, partition, certain).converged
    assert not judge(position, partition, LIMITS).ends
    assert not judge(make_position(0.1 * TOLERANCE, load=1.0), partition, certain).ends


def test_steps_in_vain_that_change_no_set_go_to_and_fro(make_position):
    """A pressure in a layer went from .04 to .63 of p_h and back, for ever; what changes sets gets on."""
    to_and_fro_for = [1.0, *BACK_AND_FORTH * [2.0]]
    assert to_and_fro(make_position(*to_and_fro_for))
    assert not to_and_fro(make_position(*to_and_fro_for[:-1]))
    assert not to_and_fro(make_position(*to_and_fro_for, changes=FILLED))
    assert not to_and_fro(make_position(*to_and_fro_for, 0.5))
