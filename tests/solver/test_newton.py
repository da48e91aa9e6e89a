"""Newton's method on one grid."""

import numpy as np
import pytest

from mgehl.discretization.kernels import REACH, build_bands, factor_bands
from mgehl.discretization.status import CAVITATED, LUBRICATED
from mgehl.solver.nested import first_guess
from mgehl.solver.newton import STALLS, Newton
from mgehl.solver.problem import ContactProblem
from mgehl.solver.settings import NewtonSettings


@pytest.fixture
def make_newton(make_hierarchy, paper_contact):
    """Factory of (problem, Newton) for the film at 1 m/s on 65 nodes; freed after the test."""
    from mgehl.discretization.scheme import Scheme
    from mgehl.multigrid.cycle import MultigridSolver

    made = []

    def make(monitor=None, options_prefix="test_", **limits):
        contact, scheme = paper_contact(), Scheme()
        hierarchy = make_hierarchy(contact, 65)
        problem = ContactProblem(hierarchy.grids[-1], hierarchy.deflections[-1], contact, scheme)
        multigrid = MultigridSolver(hierarchy, 1, contact, scheme)
        settings = NewtonSettings(**limits)
        made.append(Newton(problem, multigrid, settings, None, options_prefix, monitor))
        return problem, made[-1]

    yield make
    for newton in made:
        newton.free()


def test_it_solves_from_the_hertz_pressure(make_newton):
    problem, newton = make_newton()
    outcome = newton.run(first_guess(problem, "film"))
    state, last = outcome.state, outcome.cycles[-1]
    assert outcome.converged
    assert last.step <= 15
    assert last.residual <= 1e-8 and abs(last.load_error) <= 1e-8
    # The outcome's own words are checked against the equations.
    F = problem.residual(state, problem.inflow(state))
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


def test_the_first_guess_is_not_changed(make_newton):
    problem, newton = make_newton()
    guess = first_guess(problem, "film")
    before = guess.copy()
    newton.run(guess)
    for name in ("P", "H", "status"):
        np.testing.assert_array_equal(getattr(guess, name), getattr(before, name))
    assert guess.H0 == before.H0


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
    outcome = newton.run(guess)
    assert 0.0 < outcome.cycles[1].step_length < 1.0
    # Where the fluid is stiff nothing but the Newton step changes the pressure.
    high = guess.P > 0.6
    changed = np.abs(outcome.state.P - guess.P)[high].max()
    assert 0.0 < changed <= 1e-3 * (1.0 + 1e-9)


def test_a_looser_tolerance_stops_earlier(make_newton):
    problem, strict = make_newton()
    _, loose = make_newton(tolerance=1e-3)
    guess = first_guess(problem, "film")
    loose_outcome = loose.run(guess)
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
    factor_bands(bands)
    assert not np.all(np.isfinite(bands[1]))
    np.testing.assert_array_equal(bands[[0, 2], :, REACH], 0.5)


def test_a_line_that_becomes_singular_ends_it_with_a_reason(make_newton, monkeypatch):
    """A node that no pressure can reach leaves a row of zeros in its line: no linear solution, no step."""

    def build_singular(A, B, distributive, kappa, share, bands):
        build_bands(A, B, distributive, kappa, share, bands)
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


def test_it_gives_up_when_linear_systems_stay_unsolved(make_newton, petsc_options):
    petsc_options["few_ksp_max_it"] = 1
    problem, newton = make_newton(options_prefix="few_")
    outcome = newton.run(first_guess(problem, "film"))
    assert not outcome.converged
    assert outcome.cycles[-1].step == STALLS
    assert outcome.reason == f"{STALLS} linear systems in {STALLS} steps could not be solved"


def test_systems_solved_with_the_last_iteration_are_no_reason_to_give_up(make_newton, petsc_options):
    petsc_options["last_ksp_max_it"] = 1
    petsc_options["last_ksp_rtol"] = 0.99
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
