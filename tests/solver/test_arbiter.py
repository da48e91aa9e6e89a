"""Eq. 2 as the arbiter between settled partitions."""

from copy import deepcopy

import numpy as np
import pytest

from mgehl.discretization.band_kernels import build_bands
from mgehl.discretization.status import BOUNDARY, CONTACT, LUBRICATED
from mgehl.multigrid.cycle import MultigridSolver
from mgehl.solver.arbiter import EARLY, EARLY_ROUNDS, Ruling, rule
from mgehl.solver.inequality import check_pressure_inequality
from mgehl.solver.judge import GO_ON, Verdict
from mgehl.solver.outcome import Cycle
from mgehl.solver.partition import Changes, Partition
from mgehl.solver.position import Position, Trial
from mgehl.solver.problem import State
from mgehl.solver.verification import complementarity_error

NODES = [(3, 3), (3, 4), (5, 5)]
"""Contact in a film of P = 0.5: the first two lie under it, the third above."""

SETTLED, GIVEN_UP = Verdict(True, True, "settled"), Verdict(True, False, "given up")


@pytest.fixture
def ruling(tiny_problem):
    """Function: the ruling on a solve with three contact nodes, two of which break Eq. 2.

    `before` are the violations of an answer kept from before; nothing is changed by asking.
    """

    def ask(verdict, before=None, budget=1, residual=1e-9, released=2, entered=0, apart=False, **fields):
        partition = Partition(tiny_problem, budget)
        status = np.where(tiny_problem.boundary, BOUNDARY, LUBRICATED).astype(np.int8)
        P = np.where(tiny_problem.boundary, 0.0, 0.5)
        for node, pressure in zip(NODES, (0.4, 0.4, 0.6), strict=True):
            status[node], P[node] = CONTACT, pressure
        state = State(P, 0.0, np.ones(P.shape), status)
        cycle = Cycle(7, residual, 0.0, 1.0, 1.0, 3, 0, Changes())
        trial = None if before is None else Trial(state.copy(), "before", before, released, 15, entered)
        position = Position(state, partition.past, [cycle], trial=trial, **fields)
        kept = deepcopy(position)
        found = rule(position, verdict, partition, apart)
        np.testing.assert_array_equal(position.state.status, kept.state.status)
        np.testing.assert_array_equal(position.state.P, kept.state.P)
        np.testing.assert_array_equal(position.past.budget, kept.past.budget)
        assert (position.changes, position.early_rounds) == (kept.changes, kept.early_rounds)
        return found

    return ask


class TestAfterTheLastDigit:
    def test_what_breaks_eq_2_is_to_be_let_go(self, ruling):
        assert ruling(SETTLED) is Ruling.TRY_RELEASE

    def test_without_budget_it_is_accepted(self, ruling):
        assert ruling(SETTLED, budget=0) is Ruling.ACCEPT

    @pytest.mark.parametrize(
        "before, expected", [(1, Ruling.KEEP), (2, Ruling.KEEP), (3, Ruling.TRY_RELEASE)]
    )
    def test_the_answer_is_the_one_with_fewer_violations(self, ruling, before, expected):
        assert ruling(SETTLED, before) is expected

    def test_the_better_one_is_accepted_where_nothing_may_be_let_go(self, ruling):
        assert ruling(SETTLED, 3, budget=0) is Ruling.ACCEPT

    def test_what_did_not_settle_is_no_answer(self, ruling):
        assert ruling(GIVEN_UP) is Ruling.GIVE_UP
        assert ruling(GIVEN_UP, before=3) is Ruling.KEEP


class TestOnTheWay:
    def test_it_goes_on(self, ruling):
        assert ruling(GO_ON) is Ruling.GO_ON

    @pytest.mark.parametrize("apart", [True, False])
    def test_where_the_fluid_is_solved_apart_eq_2_is_asked_early(self, ruling, apart):
        expected = Ruling.RELEASE_EARLY if apart else Ruling.GO_ON
        assert ruling(GO_ON, residual=0.5 * EARLY, apart=apart) is expected

    @pytest.mark.parametrize("residual, rounds", [(2.0 * EARLY, 0), (0.5 * EARLY, EARLY_ROUNDS)])
    def test_not_too_early_and_not_for_ever(self, ruling, residual, rounds):
        assert ruling(GO_ON, residual=residual, apart=True, early_rounds=rounds) is Ruling.GO_ON

    def test_not_where_nothing_may_be_let_go(self, ruling):
        assert ruling(GO_ON, residual=0.5 * EARLY, apart=True, budget=0) is Ruling.GO_ON

    @pytest.mark.parametrize("released, entered, closed", [(3, 0, False), (3, 2, False), (3, 3, True)])
    def test_a_trial_ends_when_what_was_let_go_has_closed_again(self, ruling, released, entered, closed):
        found = ruling(GO_ON, 2, released=released, entered=entered)
        assert found is (Ruling.KEEP if closed else Ruling.GO_ON)


@pytest.mark.parametrize("each", Ruling)
def test_a_ruling_ends_it_or_says_what_to_do(each):
    assert each.ends == (each in (Ruling.ACCEPT, Ruling.KEEP, Ruling.GIVE_UP))


class TestInASolve:
    """Coarse grids settle with contact nodes that the fluid beside them would pry open."""

    @pytest.fixture
    def plain(self, solve, paper_contact):
        """65 nodes at 0.12 m/s as they settle first: 28 of 42 contact nodes break Eq. 2."""
        return solve(paper_contact(0.12), 65, newton={"release_budget": 0})

    def broken(self, solution):
        """How many contact nodes violate Eq. 2."""
        state = solution.outcome.state
        return len(check_pressure_inequality(solution.problem, state).violations)

    def assert_settled(self, solution):
        problem, outcome = solution.problem, solution.outcome
        found = outcome.state
        state = problem.state(found.P, found.H0, found.status, found.p, found.filling)
        assert outcome.converged and outcome.reason == "residual, load and sets settled"
        assert problem.rms(problem.residual(problem.evaluate(state), state.status)) <= 1e-8
        assert abs(problem.load_deficit(state.P)) <= 1e-8
        assert complementarity_error(problem, state, problem.evaluate(state)) <= 1e-8
        assert outcome.contradictions == []

    def assert_same(self, solution, other):
        state, other = solution.outcome.state, other.outcome.state
        np.testing.assert_array_equal(state.status, other.status)
        np.testing.assert_allclose(state.P, other.P, rtol=0.0, atol=1e-12)
        assert state.H0 == pytest.approx(other.H0, rel=1e-12)

    def released(self, solution):
        return sum(cycle.changes.released for cycle in solution.outcome.cycles)

    def test_of_two_settled_states_the_one_with_fewer_violations_is_kept(self, solve, paper_contact):
        """129 nodes at 20 mm/s from contact: 16 contact nodes are let go, and fewer break Eq. 2 then."""
        plain = solve(paper_contact(0.02), 129, start="contact", newton={"release_budget": 0})
        tried = solve(paper_contact(0.02), 129, start="contact")
        self.assert_settled(plain)
        self.assert_settled(tried)
        assert 0 < self.broken(tried) < self.broken(plain)
        assert self.released(tried) >= self.released(plain) + self.broken(plain)

    def test_what_cannot_be_improved_stays_as_it_settled(self, solve, paper_contact, plain):
        """Everything that is let go closes again."""
        tried = solve(paper_contact(0.12), 65)
        self.assert_settled(tried)
        self.assert_same(tried, plain)
        assert self.released(tried) >= self.broken(plain) > 0
        # It gives up in the step in which the last of them does; the history ends with the answer.
        *trial, last = tried.outcome.cycles[len(plain.outcome.cycles) :]
        entered = [cycle.changes.entered for cycle in trial]
        assert last.residual <= 1e-8 and last.contact_nodes == plain.outcome.cycles[-1].contact_nodes
        assert sum(entered[:-1]) < self.broken(plain) <= sum(entered)

    def test_running_out_of_steps_while_trying_is_no_failure(self, solve, paper_contact, plain):
        """The settled state is in hand when the last step is reached."""
        last = plain.finest_steps + 1
        tried = solve(paper_contact(0.12), 65, newton={"max_steps": last})
        assert tried.finest_steps == last + 1  # the answer itself is the last line
        self.assert_settled(tried)
        self.assert_same(tried, plain)

    @pytest.mark.parametrize("fault", ["singular", "too few iterations"])
    def test_a_system_without_solution_while_trying_is_no_failure(
        self, solve, paper_contact, plain, monkeypatch, fault
    ):
        """The first one after the release ends it."""

        ksps = []

        def configure(multigrid, ksp, rtol):
            configured(multigrid, ksp, rtol)
            ksps.append(ksp)

        def release(partition, state, changes):
            released(partition, state, changes)
            if changes.released and fault == "singular":
                monkeypatch.setattr("mgehl.discretization.bands.build_bands", build_singular)
            elif changes.released:
                ksps[-1].setTolerances(max_it=1)

        def build_singular(*arguments):
            build_bands(*arguments)
            *_, bands, (first, last), _ = arguments
            if first <= 30 < last:
                bands[30, 20] = 0.0

        released, configured = Partition.release_violations, MultigridSolver.configure
        monkeypatch.setattr(MultigridSolver, "configure", configure)
        monkeypatch.setattr(Partition, "release_violations", release)
        tried = solve(paper_contact(0.12), 65)
        assert tried.finest_steps == plain.finest_steps + 1  # the answer itself is the last line
        self.assert_settled(tried)
        self.assert_same(tried, plain)

    def test_a_film_without_contact_has_nothing_to_try(self, solve, paper_contact):
        tried = solve(paper_contact(), 65)
        plain = solve(paper_contact(), 65, newton={"release_budget": 0})
        assert self.broken(tried) == self.released(tried) == 0
        assert tried.finest_steps == plain.finest_steps
        self.assert_same(tried, plain)

    def test_full_contact_meets_eq_2_in_a_second_state(self, solve, paper_contact):
        """129 nodes at 0.5 mm/s: two nodes are let go, and what settles without them breaks nothing.

        The fluid is solved apart: they are let go as soon as the sets rest, not after the last digit.
        """
        solution = solve(paper_contact(5e-4), 129, start="contact")
        self.assert_settled(solution)
        assert self.broken(solution) == 0
        cycles = solution.outcome.cycles
        (release,) = [step for step, cycle in enumerate(cycles) if cycle.changes.released == 2]
        assert 1e-8 < cycles[release - 1].residual <= EARLY
        assert cycles[-1].contact_nodes == cycles[release - 1].contact_nodes - 2
