"""Newton's method on one grid."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.config import load_config
from mgehl.discretization.band_kernels import REACH, banded, build_bands
from mgehl.discretization.mesh import HALO
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import CAVITATED, LUBRICATED
from mgehl.errors import Stopped
from mgehl.model.lubricant import Barus
from mgehl.run import solve as solve_config
from mgehl.solver.journal import Journal
from mgehl.solver.judge import STALLS
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


def test_every_cycle_is_told(make_newton):
    told = []
    problem, newton = make_newton(told.append)
    outcome = newton.run(first_guess(problem, "film"))
    assert told == outcome.cycles
    assert [cycle.step for cycle in told] == list(range(len(told)))
    assert all(cycle.linear_iterations > 0 for cycle in told[1:])
    assert all(0.0 < cycle.step_length <= 1.0 for cycle in told[1:])
    central, minimum = problem.films(outcome.state)
    assert (told[-1].central, told[-1].minimum) == (central, minimum)
    counts = told[-1].contact_nodes, told[-1].cavitated_nodes
    assert counts == problem.counts(outcome.state.status)


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


def test_a_pressure_step_is_limited(make_newton):
    problem, newton = make_newton(max_steps=1, max_pressure_step=1e-3)
    guess = first_guess(problem, "film")
    outcome = newton.run(guess.copy())
    assert 0.0 < outcome.cycles[1].step_length < 1.0
    # Where the fluid is stiff nothing but the Newton step changes the pressure.
    high = guess.P > 0.6
    changed = np.abs(outcome.state.P - guess.P)[high].max()
    assert 0.0 < changed <= 1e-3 * (1.0 + 1e-9)


def test_a_looser_tolerance_stops_earlier(make_newton):
    problem, strict = make_newton()
    _, loose = make_newton(tolerance=1e-3)
    guess = first_guess(problem, "film")
    loose_outcome = loose.run(guess.copy())
    assert loose_outcome.converged
    assert loose_outcome.cycles[-1].step < strict.run(guess).cycles[-1].step


def test_a_residual_that_is_not_finite_ends_it(make_newton):
    problem, newton = make_newton()
    guess = first_guess(problem, "film")
    guess.P[30, 30] = np.nan
    outcome = newton.run(guess)
    assert not outcome.converged
    assert outcome.reason == "diverged: residual nan after 0 steps"


def test_factors_of_a_singular_line_are_not_finite():
    """Nothing is raised, and the lines beside it keep theirs."""
    bands = np.zeros((3, 20, 2 * REACH + 1))
    bands[:, :, REACH] = 2.0
    bands[1] = 0.0
    banded(REACH)[0](bands, (0, 20))
    assert not np.all(np.isfinite(bands[1]))
    np.testing.assert_array_equal(bands[[0, 2], :, REACH], 0.5)


def test_a_line_that_becomes_singular_ends_it_with_a_reason(make_newton, monkeypatch):
    """A node that no pressure can reach leaves a row of zeros in its line: no linear solution, no step."""

    def build_singular(*arguments):
        build_bands(*arguments)
        *_, bands, (first, last), _ = arguments
        if first <= 30 < last:
            bands[30, 20] = 0.0

    monkeypatch.setattr("mgehl.discretization.bands.build_bands", build_singular)
    problem, newton = make_newton(max_steps=3)
    outcome = newton.run(first_guess(problem, "film"))
    assert not outcome.converged
    assert outcome.reason == "singular: no linear solution after 0 steps"
    assert len(outcome.cycles) == 1


def test_a_residual_without_a_way_back_ends_it(make_newton):
    """Long before it overflows."""
    problem, newton = make_newton()
    guess = first_guess(problem, "film")
    guess.H0 += 1e12
    guess.H += 1e12
    guess.P[30, 30] += 0.1
    outcome = newton.run(guess)
    assert not outcome.converged
    assert outcome.reason.startswith("diverged: residual") and len(outcome.cycles) == 1


def test_petsc_options_reach_snes_and_ksp(make_newton, petsc_options):
    petsc_options["opt_snes_max_it"] = 2
    petsc_options["opt_ksp_max_it"] = 1
    problem, newton = make_newton(options_prefix="opt_")
    outcome = newton.run(first_guess(problem, "film"))
    assert not outcome.converged
    assert outcome.cycles[-1].step == 2
    assert [cycle.linear_iterations for cycle in outcome.cycles[1:]] == [1, 1]


def test_it_gives_up_when_linear_systems_stay_unsolved(make_newton, petsc_options, monkeypatch):
    """Unsolved is here what has anything left."""
    monkeypatch.setattr("mgehl.solver.newton.UNSOLVED", 0.0)
    petsc_options["few_ksp_max_it"] = 1
    petsc_options["few_ksp_rtol"] = 1e-6
    problem, newton = make_newton(options_prefix="few_")
    outcome = newton.run(first_guess(problem, "film"))
    assert not outcome.converged
    assert outcome.cycles[-1].step == STALLS
    assert outcome.reason == f"{STALLS} linear systems in {STALLS} steps could not be solved"


def test_systems_of_which_little_is_left_are_no_reason_to_give_up(make_newton, petsc_options):
    petsc_options["half_ksp_max_it"] = 1
    petsc_options["half_ksp_rtol"] = 1e-6
    problem, newton = make_newton(options_prefix="half_")
    assert newton.run(first_guess(problem, "film")).cycles[-1].step > STALLS


def test_systems_solved_with_the_last_iteration_are_no_reason_to_give_up(
    make_newton, petsc_options, monkeypatch
):
    petsc_options["last_ksp_max_it"] = 1
    petsc_options["last_ksp_rtol"] = 0.99
    monkeypatch.setattr("mgehl.solver.newton.UNSOLVED", 0.0)
    problem, newton = make_newton(options_prefix="last_", max_steps=STALLS + 1)
    outcome = newton.run(first_guess(problem, "film"))
    assert [cycle.linear_iterations for cycle in outcome.cycles[1:]] == [1] * (STALLS + 1)
    assert outcome.reason.startswith("residual")


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

    @pytest.mark.parametrize(
        "change",
        [lambda f: f.scale(-1.0), lambda f: f.shift(1e-3), lambda f: f.scale(3.0)],
        ids=["turned round", "shifted", "three times as large"],
    )
    def test_with_another_residual_there_is_no_solution(self, make_newton, change):
        problem, newton = make_newton(kind=rewired(function=then(change)), max_steps=20)
        assert not newton.run(first_guess(problem, "film")).converged

    def test_where_the_residual_says_zero_nothing_is_done(self, make_newton):
        problem, newton = make_newton(kind=rewired(function=then(lambda f: f.set(0.0))), max_steps=20)
        outcome = newton.run(first_guess(problem, "film"))
        assert [cycle.residual for cycle in outcome.cycles] == [0.0] * len(outcome.cycles)
        assert problem.rms(problem.residual(problem.evaluate(outcome.state), outcome.state.status)) > 1e-3

    def test_with_another_jacobian_there_is_no_solution(self, make_newton):
        """Turned round on the finest grid, in place."""

        def turn_round(J, _):
            linearisation = J.getPythonContext().linearisation
            linearisation.A *= -1.0
            linearisation.B *= -1.0

        problem, newton = make_newton(kind=rewired(jacobian=then(turn_round)), max_steps=20)
        assert not newton.run(first_guess(problem, "film")).converged

    def test_with_the_jacobian_of_the_first_state_it_is_not_newton_s_method(self, make_newton):
        def once(form):
            formed = []

            def first(snes, *arguments):
                if not formed:
                    formed.append(form(snes, *arguments))

            return first

        problem, newton = make_newton(kind=rewired(jacobian=once), max_steps=20)
        assert not newton.run(first_guess(problem, "film")).converged

    def test_without_one_there_is_nothing_to_solve_with(self, make_newton):
        problem, newton = make_newton(kind=rewired(jacobian=lambda form: lambda *_: None))
        with pytest.raises(AttributeError):
            newton.run(first_guess(problem, "film"))

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

    def test_of_snes_s_own_monitor(self, make_newton):
        raise_mine = self.raise_mine

        class Watched(Newton):
            def solve(self, snes, b, x):
                snes.setMonitor(raise_mine)
                super().solve(snes, b, x)

        self.assert_raised(*make_newton(kind=Watched))

    @pytest.mark.parametrize("which", ["function", "jacobian"])
    def test_of_a_callback(self, make_newton, which):
        self.assert_raised(*make_newton(kind=rewired(**{which: lambda form: self.raise_mine})))

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


def test_a_step_evaluates_the_fluid_hardly_more_than_once(monkeypatch):
    """A full film on 257 nodes in 8 steps: where the cavities move it is evaluated again.

    That of the result is included. What cavities hold needs no other evaluation.
    """
    path = Path(__file__).parents[2] / "configs" / "full_film.toml"
    config = load_config(path, ["motion.speed=1 m/s", "grid.nodes=257"])
    shapes, log_viscosity = [], Barus.log_viscosity

    def counted(law, P, p_h):
        shapes.append(np.shape(P))
        return log_viscosity(law, P, p_h)

    monkeypatch.setattr(Barus, "log_viscosity", counted)
    solved = solve_config(config, MPI.COMM_SELF)
    steps = max(row["step"] for row in solved.rows if row["grid"] == 257)
    assert solved.result.converged and steps <= 9
    whole = (257 + 2 * HALO, 257)
    on_finest = shapes[shapes.index(whole) :]  # among them the cycle's, of coarser grids
    assert on_finest.count(whole) <= 2 * steps + 2
