import sys

import numpy as np
import pytest
from processes import ended

from mgehl.discretization.status import LUBRICATED
from mgehl.solver.nested import first_guess


def test_the_solution_does_not_depend_on_the_guess(make_newton):
    problem, newton = make_newton()
    first = newton.run(first_guess(problem, "film")).state
    guess = first_guess(problem, "film")
    other = problem.state(0.9 * guess.P, guess.H0 + 0.1, np.full(guess.status.shape, LUBRICATED))
    second = newton.run(other)
    assert second.converged
    np.testing.assert_allclose(second.state.P, first.P, rtol=0.0, atol=1e-6)
    np.testing.assert_array_equal(second.state.status, first.status)


@pytest.mark.parametrize("P, H", [(np.nan, 0.0), (0.1, 1e12)], ids=["nan", "large"])
def test_a_residual_without_a_way_back_ends_it(make_newton, P, H):
    """Long before it overflows."""
    problem, newton = make_newton()
    guess = first_guess(problem, "film")
    guess.P[30, 30] += P
    guess.H0 += H
    guess.H += H
    outcome = newton.run(guess)
    assert not outcome.converged and len(outcome.cycles) == 1
    assert outcome.reason.startswith("diverged: residual")


@pytest.mark.parametrize("speed", [1.0, 0.12])
def test_implicit_time_steps_end_in_the_steady_solution(solve, paper_contact, speed):
    """Another way to the same film, at 0.12 m/s with contact."""
    ways = ({"squeeze": rate, "tolerance": 1e-10} for rate in (0.0, 3.0))
    steady, implicit = (solve(paper_contact(speed), 65, newton=way).outcome for way in ways)
    assert steady.converged and implicit.converged
    np.testing.assert_allclose(implicit.state.P, steady.state.P, rtol=0.0, atol=1e-6)
    np.testing.assert_allclose(implicit.state.H, steady.state.H, rtol=0.0, atol=1e-6)
    np.testing.assert_array_equal(implicit.state.status, steady.state.status)
    ways = ([cycle.residual for cycle in outcome.cycles] for outcome in (steady, implicit))
    assert next(ways)[1:3] != pytest.approx(next(ways)[1:3], rel=1e-3)


RAISES_INSIDE = """
from mgehl.config import load_config
from mgehl.grid.convolution import Deflection
from mgehl.run import solve
from mpi4py import MPI

products = 0

def fail(true):
    def call(deflection, P):
        global products
        products += 1
        if products > 20:
            raise RuntimeError("as it was")
        return true(deflection, P)
    return call

Deflection.__call__ = fail(Deflection.__call__)
try:
    solve(load_config(None, ["grid.nodes=65"]), MPI.COMM_SELF)
except RuntimeError as error:
    print(error)
print("freed")
"""


class TestExceptions:
    """They come out of a solve as themselves, and leave a `Newton` that can be freed."""

    class Mine(Exception):
        pass

    def raise_mine(self, *_):
        raise self.Mine("as it was")

    def assert_raised(self, problem, newton):
        with pytest.raises(self.Mine, match="^as it was$"):
            newton.run(first_guess(problem, "film"))

    def test_of_a_monitor(self, make_newton):
        self.assert_raised(*make_newton(self.raise_mine))

    def test_of_a_product_inside_the_linear_solver(self):
        """In a process of its own, which would die of it."""
        done = ended([sys.executable, "-c", RAISES_INSIDE])
        assert (done.returncode, done.stdout) == (0, "as it was\nfreed\n"), done.stderr

    def test_after_one_it_solves_again(self, make_newton):
        told = []

        def interrupt(cycle):
            told.append(cycle)
            if len(told) == 3:
                self.raise_mine()

        problem, newton = make_newton(interrupt)
        self.assert_raised(problem, newton)
        assert newton.run(first_guess(problem, "film")).converged
