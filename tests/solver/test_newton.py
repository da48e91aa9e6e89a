"""Newton's method on one grid."""

import subprocess
import sys

import numpy as np
import pytest

from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CAVITATED, LUBRICATED
from mgehl.errors import Stopped
from mgehl.model.lubricant import Barus
from mgehl.solver.journal import Journal
from mgehl.solver.nested import first_guess
from mgehl.solver.newton import Newton


def test_it_solves_from_the_hertz_pressure(make_newton):
    problem, newton = make_newton()
    outcome = newton.run(first_guess(problem, "film"))
    state, last = outcome.state, outcome.cycles[-1]
    assert outcome.converged
    assert last.step <= 15
    assert last.residual <= 1e-8 and abs(last.load_error) <= 1e-8
    # The outcome's own words are checked against the equations.
    F = problem.residual(problem.evaluate(state), state.status)
    assert problem.rms(F) <= 1e-8
    assert abs(problem.load_deficit(state.P)) <= 1e-8
    np.testing.assert_allclose(state.H, problem.gap(state.P, state.H0), rtol=0.0, atol=1e-12)
    assert state.P.min() >= 0.0
    np.testing.assert_array_equal(state.P[state.status == CAVITATED], 0.0)


def test_convergence_is_fast_at_the_end(make_newton):
    problem, newton = make_newton(linear_tolerance=1e-3)
    cycles = newton.run(first_guess(problem, "film")).cycles
    settled = [cycle.residual for cycle in cycles if cycle.changes.total == 0]
    assert len(settled) >= 2
    assert settled[-1] < 0.02 * settled[-2]


def test_a_solution_needs_no_step(make_newton):
    problem, newton = make_newton()
    first = newton.run(first_guess(problem, "film"))
    again = newton.run(first.state)
    assert again.converged
    assert again.cycles[-1].step == 0


def test_the_solution_does_not_depend_on_the_guess(make_newton):
    problem, newton = make_newton()
    first = newton.run(first_guess(problem, "film")).state
    guess = first_guess(problem, "film")
    other = problem.state(0.9 * guess.P, guess.H0 + 0.1, np.full(guess.status.shape, LUBRICATED))
    second = newton.run(other)
    assert second.converged
    np.testing.assert_allclose(second.state.P, first.P, rtol=0.0, atol=1e-6)
    np.testing.assert_array_equal(second.state.status, first.status)


def test_it_stops_at_the_last_step_and_says_so(make_newton):
    problem, newton = make_newton(max_steps=1)
    outcome = newton.run(first_guess(problem, "film"))
    assert not outcome.converged
    assert outcome.cycles[-1].step == 1
    assert "1 steps" in outcome.reason


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


def test_petsc_options_reach_snes_and_ksp(make_newton, petsc_options):
    petsc_options["opt_snes_max_it"] = 2
    petsc_options["opt_ksp_max_it"] = 1
    problem, newton = make_newton(options_prefix="opt_")
    outcome = newton.run(first_guess(problem, "film"))
    assert not outcome.converged
    assert outcome.cycles[-1].step == 2
    assert [cycle.linear_iterations for cycle in outcome.cycles[1:]] == [1, 1]


@pytest.mark.parametrize("speed", [1.0, 0.12])
def test_implicit_time_steps_end_in_the_steady_solution(solve, paper_contact, speed):
    """Another way to the same film, at 0.12 m/s with contact."""
    steady, implicit = (
        solve(paper_contact(speed), 65, newton={"squeeze": squeeze, "release_budget": 0}).outcome
        for squeeze in (0.0, 3.0)
    )
    assert steady.converged and implicit.converged
    np.testing.assert_allclose(implicit.state.P, steady.state.P, rtol=0.0, atol=1e-6)
    np.testing.assert_allclose(implicit.state.H, steady.state.H, rtol=0.0, atol=1e-6)
    np.testing.assert_array_equal(implicit.state.status, steady.state.status)
    ways = ([cycle.residual for cycle in outcome.cycles] for outcome in (steady, implicit))
    assert next(ways)[1:3] != pytest.approx(next(ways)[1:3], rel=1e-3)


class Rewired(Newton):
    """A `Newton` whose SNES has callbacks of the test's own, made of the true ones."""

    wrap_function = wrap_jacobian = None
    """Of (newton, callback), giving the callback that SNES is to have."""

    def solve(self, snes, b, x):
        if self.wrap_function:
            f, (form, *_) = snes.getFunction()
            snes.setFunction(self.wrap_function(form), f)
        if self.wrap_jacobian:
            J, preconditioner, (form, *_) = snes.getJacobian()
            snes.setJacobian(self.wrap_jacobian(form), J, preconditioner)
        super().solve(snes, b, x)


def rewired(function=None, jacobian=None):
    """A kind of `Newton` with these wrappers."""
    wrappers = {"wrap_function": function, "wrap_jacobian": jacobian}
    return type(
        "Rewired", (Rewired,), {name: each and staticmethod(each) for name, each in wrappers.items()}
    )


def then(change):
    """Wrapper of a callback: the true one, then a change of what it made."""

    def wrap(form):
        def formed(snes, x, *made):
            form(snes, x, *made)
            change(*made)

        return formed

    return wrap


class TestItAsksSnes:
    """What SNES's callbacks say is what is solved."""

    def test_monitors_see_what_the_outcome_says(self, make_newton):
        seen = []

        class Watched(Newton):
            def solve(self, snes, b, x):
                snes.setMonitor(lambda snes, step, norm: seen.append((step, norm)))
                super().solve(snes, b, x)
                seen.append((snes.getIterationNumber(), snes.getFunctionNorm()))
                assert snes.getConvergedReason() > 0

        problem, newton = make_newton(kind=Watched)
        cycles = newton.run(first_guess(problem, "film")).cycles
        told = [(cycle.step, cycle.residual) for cycle in cycles]
        assert seen == [*told, told[-1]]


class TestJacobianThroughSnes:
    """What SNES's Jacobian does to a direction, against differences of SNES's function."""

    STEP = 1e-3

    @pytest.mark.parametrize(
        "couette, motion, speed",
        [("1B", (1.0, 0.0), 0.3), ("S1B", (0.0, 1.0), 0.3), ("1B", (0.8, 0.6), 0.2)],
        ids=["along x", "along y", "at an angle"],
    )
    def test_rest_is_of_second_order(self, make_newton, paper_contact, usual_law, couette, motion, speed):
        """Half the step, a quarter of what the linearisation leaves; and hardly anything of the whole.

        (In a settled state: where cavities have just moved, the function at the present state is
        still that of the gap before.)
        """
        contact = paper_contact(speed)
        scheme = Scheme(couette, motion=motion, contact_law=usual_law(contact))
        problem, newton = make_newton(contact=contact, scheme=scheme, release_budget=0)
        settled = newton.run(first_guess(problem, "film"))
        assert settled.converged and set(np.unique(settled.state.status)) >= set(range(3))
        found = []

        def measure(form):
            def formed(snes, x, J, preconditioner):
                form(snes, x, J, preconditioner)
                found.append(self.rests(snes, x, J, problem.boundary))

            return formed

        kind = rewired(jacobian=measure)
        _, newton = make_newton(kind=kind, contact=contact, scheme=scheme, tolerance=0.0, max_steps=1)
        newton.run(settled.state)
        ((jump, whole, half, change),) = found
        assert jump < 1e-6 * whole
        assert half == pytest.approx(0.25 * whole, rel=0.05)
        assert 0.0 < whole < 1e-3 * change

    def rests(self, snes, x, J, boundary):
        """Norms of f(x + h d) - f(x) - h J d for h = 0+, h and h/2, and of h J d."""
        d, here, there, product = x.duplicate(), *(snes.getFunction()[0].duplicate() for _ in range(3))
        noise = np.random.default_rng(3).standard_normal(boundary.shape)
        P = x.getArray(readonly=True)[:-1].reshape(boundary.shape)
        d.setArray(np.append(np.where(boundary, 0.0, noise * P), 0.01))
        J.mult(d, product)
        snes.computeFunction(x, here)
        norms = []
        for h in (1e-12, self.STEP, 0.5 * self.STEP):
            moved = x.copy()
            moved.axpy(h, d)
            snes.computeFunction(moved, there)
            there.axpy(-1.0, here)
            there.axpy(-h, product)
            norms.append(there.norm())
            moved.destroy()
        norms.append(self.STEP * product.norm())
        for vec in (d, here, there, product):
            vec.destroy()
        return norms


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

    def test_of_a_law_that_a_callback_asks(self, make_newton, monkeypatch):
        problem, newton = make_newton()
        guess, calls, log_viscosity = first_guess(problem, "film"), [], Barus.log_viscosity

        def later(*arguments):
            calls.append(1)
            return self.raise_mine() if len(calls) > 3 else log_viscosity(*arguments)

        monkeypatch.setattr(Barus, "log_viscosity", later)
        with pytest.raises(self.Mine, match="^as it was$"):
            newton.run(guess)

    def test_of_a_product_inside_the_linear_solver(self):
        """In a process of its own, which would die of it."""
        done = subprocess.run([sys.executable, "-c", RAISES_INSIDE], capture_output=True, text=True)
        assert (done.returncode, done.stdout) == (0, "as it was\nfreed\n"), done.stderr

    def test_of_the_journal(self, make_newton):
        class Ends(Journal):
            def step(self, grid, position):
                if len(position.cycles) == 2:
                    raise Stopped("enough", 130)

        problem, newton = make_newton()
        with pytest.raises(Stopped, match="enough"):
            newton.run(first_guess(problem, "film"), Ends())

    def test_after_one_it_solves_again(self, make_newton):
        told = []

        def interrupt(cycle):
            told.append(cycle)
            if len(told) == 3:
                self.raise_mine()

        problem, newton = make_newton(interrupt)
        self.assert_raised(problem, newton)
        assert newton.run(first_guess(problem, "film")).converged
