"""Where a solve stands, as plain data and arrays and back."""

import json
from dataclasses import fields, is_dataclass
from math import inf, nan

import numpy as np
import pytest

from mgehl.output.records import Reader, Writer
from mgehl.solver.nested import first_guess
from mgehl.solver.outcome import Cycle, Outcome
from mgehl.solver.partition import Changes, Contradiction, Past
from mgehl.solver.position import Position, Step, Trial
from mgehl.solver.problem import State
from mgehl.solver.relaxation import Standing, Sweep


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


@pytest.fixture
def there_and_back(tiny_problem):
    """Function: the object that the JSON of a thing comes alive as."""

    def travel(thing):
        writer = Writer(tiny_problem.grid)
        text = json.dumps(writer.plain(thing))
        return Reader(tiny_problem.grid, writer.arrays).alive(json.loads(text))

    return travel


@pytest.fixture
def state(tiny_problem):
    return first_guess(tiny_problem, "film")


CYCLE = Cycle(3, nan, -inf, 0.1 + 0.2, 5e-324, 11, 222, Changes(1, 2, 3, 4), 5, 1.0 / 3.0)
NODE = Contradiction(1, 2, -1e-17, -0.1, ("lubricated", "contact"))


def test_a_position_of_newton(there_and_back, state):
    past = Past.none(state.P.shape, 2)
    past.turns[4, 4], past.was_released[3, 3], past.closing_gap[4, 4] = 7, True, nan
    answer = State(2.0 * state.P, -0.3, state.H, state.status)
    trial = Trial(answer, "settled", violations=17, released=3, limit=60, entered=1)
    position = Position(state, past, [CYCLE, CYCLE], Changes(5), Step(12, 0.7), trial, 2, 1)
    assert_equal(there_and_back(position), position)


def test_a_position_without_a_trial(there_and_back, state):
    position = Position(state, Past.none(state.P.shape, 0))
    back = there_and_back(position)
    assert back.trial is None
    assert_equal(back, position)


def test_an_outcome(there_and_back, state):
    outcome = Outcome(state, False, "why", [CYCLE, CYCLE], [NODE])
    assert_equal(there_and_back(outcome), outcome)


def test_a_standing_of_the_relaxation(there_and_back, state):
    sweep = Sweep(100, 1e-3, 0.0, 0.1, 0.2, 3, 4, 0.5, 0.25, 0.125)
    standing = Standing(Outcome(state, False, "", [sweep]), 137)
    assert_equal(there_and_back(standing), standing)


def test_numbers_of_numpy_become_plain(there_and_back):
    back = there_and_back([np.float64(0.1), np.int8(3), np.bool_(True)])
    assert_equal(back, [0.1, 3, True])


def test_what_comes_back_is_no_view_of_what_was_read(tiny_problem, state):
    """The iteration goes on in place."""
    writer = Writer(tiny_problem.grid)
    plain = writer.plain(state)
    back = Reader(tiny_problem.grid, writer.arrays).alive(plain)
    back.P += 1.0
    assert not np.array_equal(back.P, state.P)


def test_nothing_else_comes_to_life(tiny_problem):
    with pytest.raises(KeyError):
        Reader(tiny_problem.grid, {}).alive({"kind": "Popen", "fields": {"args": "true"}})
