"""From a scene to its march: the state that it begins with, and the parts of its solver."""

from dataclasses import replace

import numpy as np

from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.solver.beginning import begin
from mgehl.solver.carry import Reference
from mgehl.solver.dry import guess_on_finest, solve_dry
from mgehl.solver.march import March
from mgehl.solver.on_grid import newton_on
from mgehl.solver.pace import Retraced
from mgehl.solver.recipe import DRY, recipe_in_time
from mgehl.solver.restart import begun_in_time

AHEAD = 0.1
"""Part of the tolerance of steps to which the beginning is solved: what its residual drives grows a few
times in the first ones, which else would have to be solved although nothing changes."""

SAME = 1e-6
"""Part by which pressures of a state to start from may be off the steady one: then it is that."""


def march(scene, task, told, start=None, pace=None):
    """Run a `Scene` in time on the finest grid; return its `ContactProblem` and its `Outcome`.

    The `Task` is that of the scene's contact. From `start`, a `Solution` and the `Frame` here, or from the
    steady state of its beginning; where no heights move that state is found for its `Reference`, too.
    `told` is called after each step, as `March` says, the monitor for each cycle on the way to the
    beginning. Without a `pace` steps are as long as `Pace` says.
    """
    recipe, path = recipe_in_time(task.settings, task.contact), start[0].path if start else (0.0, 0.0)
    problem = task.but(scheme=recipe.scheme).problem()
    rests, reference, begins, state = scene.speed.value(0.0) == 0.0, None, None, None
    stays = not rests and not scene.moves
    if stays or not start:
        steady, first = (_at_rest if rests else _steady)(scene, task)
        if not first.converged and not start:
            first.reason = f"the steady state that time begins with: {first.reason}"
            return problem, first
        if first.converged and stays:
            reference = Reference.of(steady, first.state)
        state, begins = first.state, first.begins
    if start:
        problem.turn_to(scene.at(path), scene.instant(scene.framed, 0.0), scene.sense(0.0))
        before, state, begins = state, begun_in_time(problem, *start), None
        if reference and _is(problem, state, before):
            state = before
    with newton_on(task.hierarchy, problem, recipe) as newton:
        marching = March(scene, problem, newton, task.settings.time, told, pace)
        outcome = marching.run(state, path, reference, task.journal)
    return problem, replace(outcome, begins=begins)


def march_beside(scene, task, times, told, start=None):
    """The same on the next coarser grid, in steps of two of those that end at `times`: its `Outcome`."""
    coarser = replace(task, hierarchy=task.hierarchy.coarser())
    return march(scene, coarser, told, start, Retraced(times, scene))[1]


def _is(problem, state, steady):
    """Whether a state is the steady one but for the last digits."""
    off = problem.rms(state.P - steady.P)
    return off <= SAME * problem.rms(steady.P) and not problem.grid.count(state.status != steady.status)


def _steady(scene, task):
    """The steady problem at the beginning and its `Outcome`, solved beyond what steps are."""
    newton, steps = task.settings.newton, task.settings.time
    finer = task.limited(tolerance=min(newton.tolerance, AHEAD * steps.least))
    return begin(replace(finer, contact=scene.instant(task.contact, 0.0)))


def _at_rest(_scene, task):
    """The problem and the `Outcome` of the dry contact in a bath of oil: between solids it is without
    pressure, and around them it fills the gap."""
    problem, scheme, limits = task.problem(), task.settings.scheme, task.settings.newton
    guess = guess_on_finest(task.hierarchy, task.contact, scheme)
    how = limits.tolerance, limits.max_steps, lambda cycle: None, task.journal
    outcome = solve_dry(problem, guess, *how)
    P, layers = outcome.state.P, scheme.contact_law.contact_gap
    status = np.where(P > 0.0, CONTACT, LUBRICATED)
    outcome.state = problem.state(P, outcome.state.H0 + layers, status, np.zeros(P.shape))
    return problem, replace(outcome, begins=DRY)
