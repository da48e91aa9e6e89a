"""The way to a solution where there is none to begin with."""

from dataclasses import replace
from functools import partial

from mgehl.solver.continuation import SPEED_RATIO, Continuation
from mgehl.solver.nested import nested_iteration
from mgehl.solver.recipe import IN_CONTACT, OTHER_SIDE, THICK_FILM, TOUCHING
from mgehl.solver.recipe_words import NAMES

COVERED = 1.5
"""Film over the roughness from which on a walk down in speed may begin: above 1, or it begins dry, too."""

OF_A_START = 0.5
"""Part of the work that is allowed (`solver.max_work`) for a start that may be the wrong one: another
solution, or one side where contact shuts its faces. Most points of sweeps take 30 to 360 convolutions, near
rest without layers up to 1900; a ground ball at 0.35 m/s, from 0.6 m/s, took 4000 in vain. From the right
side contact that shuts its faces takes 30 to 200."""

NOR = "; nor from"
"""Begins, in the reason of a failure, what is said of every other way that was tried."""


def begin(task):
    """Solve a `Task` in the way that surface and mean of the mobility need, and from what else its `Recipe`
    names where that leads nowhere; as `nested_iteration`."""
    otherwise = task.recipe.otherwise
    may_be_wrong = set(otherwise) & OTHER_SIDE.keys()
    first = task.within(OF_A_START) if may_be_wrong else task
    others = [(NAMES[guess], partial(_from, guess)) for guess in otherwise]
    return first_found(task, [("as asked", lambda _: _as_asked(first)), *others])


def _as_asked(task):
    recipe = task.recipe
    if not recipe.scheme.may_fold or recipe.peaks == TOUCHING:
        return nested_iteration(task)
    if recipe.begins == IN_CONTACT:
        return nested_iteration(replace(task, settings=task.settings.squeezed()))
    return Continuation(task).begin()


def _from(guess, task):
    """The same from another first guess, which the `Outcome` names where it leads to an answer."""
    problem, outcome = begin_thick(task) if guess == THICK_FILM else nested_iteration(task.but(start=guess))
    return problem, replace(outcome, begins=guess) if outcome.converged else outcome


def first_found(task, ways):
    """Problem and `Outcome` of the first way that leads to an answer, of `ways` (where it begins, function
    of a `Task`). Where none does, the `Outcome` is the first one's, and has the reason of each. The others
    are tried with what work is left."""
    (_, way), *others = ways
    problem, outcome = way(task)
    if outcome.converged or not task.may_go_on:
        return problem, outcome
    reason = outcome.reason
    for where, way in others:
        news = f"not found: {reason}; now from {where}"
        found, last = way(replace(task, monitor=_with_news(task.monitor, news)))
        if last.converged:
            return found, last
        reason += f"{NOR} {where}: {last.reason}"
    return problem, replace(outcome, reason=reason)


def _with_news(monitor, news):
    """A monitor that tells news with each level."""
    return lambda level, cycle: monitor(replace(level, news=news), cycle)


def begin_thick(task):
    """Solve at a speed at which the film covers the peaks, and slow down: film fills the valleys.

    The valleys of the dry contact are empty; between rough lines they would fill one after the other from
    the inlet on. Solutions on the way are exact: looser ones lead to fewer answers.
    """
    faster = task.contact
    while faster.expected_film < COVERED * task.contact.roughness:
        faster = faster.at_speed(SPEED_RATIO * faster.speed)
    return Continuation(task).slow_down(*begin(replace(task, contact=faster)))
