"""The way to a solution where there is none to begin with."""

from dataclasses import replace
from functools import partial

from mgehl.discretization.fluid import FOLDING
from mgehl.solver.continuation import SPEED_RATIO, Continuation
from mgehl.solver.nested import nested_iteration
from mgehl.solver.recipe import DRY, FULL_FILM, IN_CONTACT, THICK_FILM, TOUCHING, on_mesh, recipe_of

COVERED = 1.5
"""Film over the roughness from which on a walk down in speed may begin: above 1, or it begins dry, too."""

OF_THE_FIRST = 0.75
"""Part of the work that is allowed (`solver.max_work`) for the start that is asked for where contact shuts
its faces; from the right one 30 to 200 convolutions do."""

NAMES = {
    DRY: "the dry contact without oil",
    THICK_FILM: "a thick film",
    FULL_FILM: "a film",
    IN_CONTACT: "contact",
}

NOR = "; nor from"
"""Begins, in the reason of a failure, what is said of every other way that was tried."""


def begin(task):
    """Solve a `Task` in the way that surface and mean of the mobility need, and from what else its `Recipe`
    names where that leads nowhere; as `nested_iteration`."""
    recipe = recipe_of(task.settings, task.contact)
    first = task.within(OF_THE_FIRST) if recipe.otherwise and recipe.peaks != TOUCHING else task
    others = [(NAMES[guess], partial(_from, guess)) for guess in recipe.otherwise]
    return first_found(task, [("as asked", lambda _: _as_asked(first)), *others])


def _as_asked(task):
    contact, settings = task.contact, task.settings
    if recipe_of(settings, contact).peaks == TOUCHING:
        return nested_iteration(task)
    if settings.scheme.face_mobility not in FOLDING:
        return nested_iteration(replace(task, settings=on_mesh(settings, contact, task.mesh)))
    if settings.start == IN_CONTACT:
        return nested_iteration(task.but(newton=settings.newton.squeezed()))
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
