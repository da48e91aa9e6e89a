"""From a scene to its march: the state that it begins with, and the parts of its solver."""

from dataclasses import replace

import numpy as np

from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.solver.beginning import begin
from mgehl.solver.carry import Reference
from mgehl.solver.dry import guess_on_finest, solve_dry
from mgehl.solver.journal import NOTHING_KEPT
from mgehl.solver.march import March
from mgehl.solver.on_grid import newton_on
from mgehl.solver.problem import ContactProblem
from mgehl.solver.recipe import DRY, recipe_in_time
from mgehl.solver.restart import interpolated


def march(scene, hierarchy, settings, told, monitor, journal=NOTHING_KEPT, start=None):
    """Run a `Scene` in time on the finest grid; return its `ContactProblem` and its `Outcome`.

    From `start`, a `Solution` and the `Frame` here, or from the steady state of its beginning. `told` is
    called after each step, as `March` says, `monitor` for each cycle on the way to the beginning.
    """
    reference = begins = None
    contact, grid, deflection = scene.framed, hierarchy.grids[-1], hierarchy.deflections[-1]
    recipe = recipe_in_time(settings, contact)
    problem = ContactProblem(grid, deflection, contact, recipe.scheme)
    if start:
        state = interpolated(problem, *start)
    else:
        beginning = _at_rest if scene.speed.value(0.0) == 0.0 else _steady
        steady, first = beginning(scene, hierarchy, settings, monitor, journal)
        if not first.converged:
            first.reason = f"the steady state that time begins with: {first.reason}"
            return problem, first
        state, begins = first.state, first.begins
        if beginning is _steady and not scene.moves:
            reference = Reference.of(steady, state)
    with newton_on(hierarchy, problem, recipe) as newton:
        outcome = March(scene, problem, newton, settings.time, told).run(state, reference, journal)
    return problem, replace(outcome, begins=begins)


def _steady(scene, hierarchy, settings, monitor, journal):
    """The steady problem at the beginning and its `Outcome`."""
    contact = scene.instant(scene.framed, 0.0)
    return begin(hierarchy, contact, settings, monitor, journal)


def _at_rest(scene, hierarchy, settings, monitor, journal):
    """The problem and the `Outcome` of the dry contact in a bath of oil: between solids it is without
    pressure, and around them it fills the gap."""
    contact, grid, scheme = scene.framed, hierarchy.grids[-1], settings.scheme
    problem = ContactProblem(grid, hierarchy.deflections[-1], contact, scheme)
    guess = guess_on_finest(hierarchy, contact, scheme)
    limits = settings.newton.tolerance, settings.newton.max_steps
    outcome = solve_dry(problem, guess, *limits, lambda cycle: None, journal)
    P, layers = outcome.state.P, scheme.contact_law.contact_gap
    status = np.where(P > 0.0, CONTACT, LUBRICATED)
    outcome.state = problem.state(P, outcome.state.H0 + layers, status, np.zeros(P.shape))
    return problem, replace(outcome, begins=DRY)
