"""The way back from a step that led astray."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from mgehl.discretization.contact_law import BoundaryFilm
from mgehl.discretization.scheme import Scheme
from mgehl.solver.foothold import (
    ASTRAY,
    HARD,
    IN_VAIN,
    JUDGED,
    LONGER,
    LONGEST,
    SHORTER,
    SHORTEST,
    Foothold,
    led_astray,
    lengthened,
)
from mgehl.solver.nested import first_guess
from mgehl.solver.newton import Newton
from mgehl.solver.squeeze import SQUEEZE

SMALL = 0.1 * JUDGED


def position(before, after, iterations=HARD, shorter=1.0, stalls=0):
    """One after a step from residual `before` to `after`."""
    foothold = Foothold(state=None, past=None, residual=before)
    cycles = [SimpleNamespace(residual=after, linear_iterations=iterations)]
    return SimpleNamespace(foothold=foothold, cycles=cycles, shorter=shorter, stalls=stalls)


@pytest.mark.parametrize(
    "before, after, expected",
    [
        (SMALL, 0.99 * ASTRAY * SMALL, False),
        (SMALL, 1.01 * ASTRAY * SMALL, True),
        (SMALL, np.nan, True),
        (1.01 * JUDGED, 100.0 * JUDGED, False),
    ],
)
def test_a_step_leads_astray_where_the_residual_is_small_and_rises_by_much(before, after, expected):
    assert led_astray(position(before, after)) == expected


def test_a_step_of_full_length_does_so_where_gmres_took_many_iterations():
    assert not led_astray(position(SMALL, 1.0, HARD - 1))
    assert led_astray(position(SMALL, 1.0, HARD - 1, shorter=SHORTER))


@pytest.mark.parametrize("before", [SMALL, 1.0])
def test_where_nearby_nodes_are_solved_at_once_every_step_may(before):
    astray, fine = position(before, 1.01 * ASTRAY * before, 1), position(before, 0.99 * ASTRAY * before, 1)
    assert led_astray(astray, every_step=True) and not led_astray(astray)
    assert not led_astray(fine, every_step=True)


@pytest.mark.parametrize(
    "residual, every_step, least",
    [(SMALL, False, 1.0), (1.01 * JUDGED, True, 1.0)],
)
def test_time_steps_become_longer_from_step_to_step(residual, every_step, least):
    shortened = position(residual, residual, shorter=SHORTER)
    assert lengthened(shortened, every_step) == LONGER * SHORTER
    assert lengthened(position(residual, residual, shorter=least), every_step) == least


def test_where_every_step_is_judged_they_become_longer_than_their_rule_and_begin_again():
    assert lengthened(position(SMALL, SMALL), every_step=True) == LONGER
    assert lengthened(position(SMALL, 2.0 * SMALL), every_step=True) == 2.0 * LONGER
    assert lengthened(position(SMALL, SMALL, shorter=LONGEST), every_step=True) == SHORTER


@pytest.mark.parametrize("times", [1, 2])
def test_steps_in_vain_may_go_round_in_a_circle_which_shorter_ones_leave(times):
    gone_round = position(SMALL, SMALL)
    gone_round.cycles *= times * IN_VAIN
    assert lengthened(gone_round) == 1.0
    gone_round.cycles.append(gone_round.cycles[0])
    assert lengthened(gone_round) == SHORTER
    gone_round.shorter = 10.0 * SHORTER
    assert lengthened(gone_round) == 10.0 * LONGER * SHORTER
    gone_round.cycles.append(SimpleNamespace(residual=0.5 * SMALL))
    assert lengthened(gone_round) == 10.0 * LONGER * SHORTER
    gone_round.shorter = 1.0
    assert lengthened(gone_round) == 1.0


def test_a_linear_system_that_was_given_up_led_nowhere():
    assert led_astray(position(SMALL, SMALL, stalls=1))


def test_without_a_foothold_no_step_is_taken_back():
    assert not led_astray(SimpleNamespace(foothold=None, cycles=[SimpleNamespace(residual=1.0)]))


def test_time_steps_become_shorter_to_a_limit():
    assert not led_astray(position(SMALL, 1.0, shorter=SHORTEST))


class Stumbling(Newton):
    """Takes one wrong step, from the first state of a small residual, after a hard linear system."""

    stumbled_at = None

    def _step(self):
        super()._step()
        before, state = self._position.cycles[-1], self._position.state
        if self.stumbled_at is None and before.residual < JUDGED:
            self.stumbled_at = before.step
            state.P *= 1.1
            state.H = self._problem.gap(state.P, state.H0)
            self._position.step = replace(self._position.step, linear_iterations=HARD)


CONTINUOUS = Scheme(face_mobility="linear-gap", contact_law=BoundaryFilm(1e-6))


@pytest.fixture
def solved(make_newton):
    """Function: the solver of that kind and its outcome, the film at 1 m/s in time steps."""

    def solve(kind, squeeze=SQUEEZE):
        problem, newton = make_newton(kind=kind, scheme=CONTINUOUS, squeeze=squeeze)
        return newton, newton.run(first_guess(problem, "film"))

    return solve


class TestASolveThatStumbles:
    def test_it_goes_on_where_it_was(self, solved):
        newton, outcome = solved(Stumbling)
        at = newton.stumbled_at
        before, astray, again = outcome.cycles[at : at + 3]
        assert astray.residual > ASTRAY * before.residual
        assert (again.residual, again.load_error, again.central) == (
            before.residual,
            before.load_error,
            before.central,
        )

    def test_to_the_same_answer(self, solved):
        (_, outcome), (_, steady) = solved(Stumbling), solved(Newton)
        assert outcome.converged
        np.testing.assert_allclose(outcome.state.H, steady.state.H, rtol=0.0, atol=1e-7)

    def test_in_shorter_steps(self, solved):
        """The step that it takes instead of the wrong one leaves more than Newton's."""
        (newton, outcome), (_, steady) = solved(Stumbling), solved(Newton)
        at = newton.stumbled_at
        assert outcome.cycles[at + 3].residual > 1.5 * steady.cycles[at + 1].residual
        assert SHORTER > 2.0

    def test_without_time_steps_it_goes_on_from_there(self, solved):
        newton, outcome = solved(Stumbling, squeeze=0.0)
        at = newton.stumbled_at
        assert outcome.cycles[at + 2].residual != outcome.cycles[at].residual
