"""What is kept of a solve: names and values as described, and back to what they were made of."""

import json
import re
from dataclasses import fields, is_dataclass
from functools import partial
from math import inf, nan
from types import SimpleNamespace

import numpy as np
import pytest

from mgehl.multigrid.jacobian import BorderedSpace
from mgehl.multigrid.memory import Corrections
from mgehl.multigrid.valleys import AT_ONCE, BY_LINES
from mgehl.solver import record as described
from mgehl.solver.dry import DryStanding, DryStep
from mgehl.solver.nested import first_guess
from mgehl.solver.outcome import Cycle, Outcome
from mgehl.solver.partition import Changes, Contradiction, Past
from mgehl.solver.position import Position, Step, Trial
from mgehl.solver.problem import State
from mgehl.solver.record import Record
from mgehl.solver.relaxation import Standing, Sweep
from mgehl.solver.remembered import Remembered

CYCLE = Cycle(3, nan, -inf, 0.1 + 0.2, 5e-324, 11, 222, Changes(1, 2, 3, 4), 5, 1.0 / 3.0)
SWEEP = Sweep(100, 1e-3, 0.0, 0.1, 0.2, 3, 4, 0.5, 0.25, 0.125)
DRY = DryStep(2, 1e-3, 0.0, 7, 3, 2)
NODE = Contradiction(1, 2, -1e-17, -0.1, ("lubricated", "contact"))


def assert_equal(one, other):
    """Of the same types (numpy's numbers have become plain), arrays bitwise, NaN equal to NaN."""
    other = other.item() if isinstance(other, np.generic) else other
    assert type(one) is type(other)
    if is_dataclass(one):
        for field in fields(one):
            assert_equal(getattr(one, field.name), getattr(other, field.name))
    elif isinstance(one, np.ndarray):
        assert one.dtype == other.dtype
        np.testing.assert_array_equal(one, other)
    elif isinstance(one, list | tuple):
        assert len(one) == len(other)
        for pair in zip(one, other, strict=True):
            assert_equal(*pair)
    else:
        assert one == other or (one != one and other != other)


def back(kept, made=None):
    """What is made of a record that has been JSON."""
    record = kept.record()
    values = json.loads(json.dumps(record.values))
    return (made or type(kept).from_record)(Record(values, record.arrays))


@pytest.fixture
def state(tiny_problem):
    return first_guess(tiny_problem, "film")


@pytest.fixture
def position(state):
    """One of Newton's method while Eq. 2 is tried."""
    past = Past.none(state.P.shape, 2)
    past.turns[4, 4], past.was_released[3, 3], past.closing_gap[4, 4] = 7, True, nan
    state.p, state.filling = 0.7 * state.P, np.full(state.P.shape, 0.4)
    answer = State(2.0 * state.P, -0.3, state.H, state.status, 0.9 * state.P, 0.6 * state.filling)
    trial = Trial(answer, "settled", 17, 12, 40, 3)
    return Position(state, past, [CYCLE, CYCLE], Changes(5), Step(12, 0.7), trial, 3, 1)


class Solver:
    """As much of a linear solver as is asked for what it remembers."""

    def __init__(self, grid, known=None):
        self.space, self.memory = BorderedSpace(grid), SimpleNamespace(known=known)
        self.way = AT_ONCE if known is not None else BY_LINES


@pytest.fixture
def corrections(tiny_problem):
    """Three of them, random."""
    nodes = tiny_problem.grid.mesh.nodes
    sizes = nodes + 1, nodes, nodes + 1  # deflections have no border
    return Corrections(*(np.random.default_rng(n).random((3, n)) for n in sizes))


@pytest.fixture
def standing(state):
    return Standing(state, [SWEEP, SWEEP], 137)


@pytest.fixture
def ended(state):
    """Function: an `Outcome` with lines of one kind in its history."""
    return lambda line: Outcome(state, False, "why", [line, line], [NODE])


class TestThereAndBack:
    def test_a_position_of_newton(self, position):
        assert_equal(back(position), position)

    def test_a_position_without_a_trial(self, state):
        position = Position(state, Past.none(state.P.shape, 0))
        assert not position.record().part("trial")
        assert_equal(back(position), position)

    def test_what_the_linear_solver_remembers(self, position, corrections, tiny_problem):
        """In a position it stays a record until a linear solver takes it back."""
        position.memory = Remembered(Solver(tiny_problem.grid, corrections))
        solver = Solver(tiny_problem.grid)
        Remembered(solver).take_back(back(position).memory)
        assert_equal(solver.memory.known, corrections)
        assert solver.way == AT_ONCE

    def test_a_standing_of_the_relaxation(self, standing):
        assert_equal(back(standing), standing)

    @pytest.mark.parametrize("line", [CYCLE, SWEEP, DRY], ids=["Cycle", "Sweep", "DryStep"])
    def test_an_outcome(self, ended, line):
        outcome = ended(line)
        assert_equal(back(outcome, partial(Outcome.from_record, line=type(line))), outcome)


def test_the_names_are_those_described(position, standing, ended, corrections, tiny_problem):
    """Who changes a name changes the format: the description, and its number in `output.checkpoint`."""
    names = set()
    position.memory = Remembered(Solver(tiny_problem.grid, corrections))
    for kept in (position, standing, ended(CYCLE), ended(SWEEP), DryStanding(np.eye(3), [DRY]), ended(DRY)):
        names |= kept.record().values.keys() | kept.record().arrays.keys()
    lines = re.findall(r"^    (\S.*)$", described.__doc__, re.MULTILINE)
    listed = [name for line in lines for name in line.split()]
    assert sorted(listed) == sorted(names)
