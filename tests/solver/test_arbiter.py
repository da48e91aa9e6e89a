import numpy as np
import pytest

from mgehl.solver.arbiter import EARLY
from mgehl.solver.inequality import check_pressure_inequality
from mgehl.solver.verification import complementarity_error


class TestInASolve:
    """Coarse grids settle with contact nodes that the fluid beside them would pry open."""

    @pytest.fixture
    def plain(self, solve, paper_contact):
        """65 nodes at 0.12 m/s as they settle first: 28 of 42 contact nodes break Eq. 2."""
        return solve(paper_contact(0.12), 65, newton={"release_budget": 0})

    def broken(self, solution):
        state = solution.outcome.state
        return check_pressure_inequality(solution.problem, state).violations

    def assert_settled(self, solution):
        problem, outcome = solution.problem, solution.outcome
        state = problem.with_own_gap(outcome.state)
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
