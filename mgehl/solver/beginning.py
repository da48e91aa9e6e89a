"""The way to a solution where there is none to begin with."""

from dataclasses import replace

from mgehl.discretization.fluid import FOLDING
from mgehl.solver.continuation import SPEED_RATIO, Continuation
from mgehl.solver.nested import nested_iteration
from mgehl.solver.recipe import DRY, IN_CONTACT, THICK_FILM, TOUCHING, on_mesh, recipe_of

COVERED = 1.5
"""Film over the roughness from which on a walk down in speed may begin: above 1, or it begins dry, too."""

NOR = "; nor from"
"""Begins, in the reason of a failure, what is said of every other way that was tried."""


def begin(task):
    """Solve a `Task` in the way that surface and mean of the mobility need; as `nested_iteration`."""
    contact, settings = task.contact, task.settings
    if recipe_of(settings, contact).peaks == TOUCHING:
        return _begin_touching(task)
    if settings.scheme.face_mobility not in FOLDING:
        return nested_iteration(replace(task, settings=on_mesh(settings, contact, task.mesh)))
    if settings.start == IN_CONTACT:
        return nested_iteration(task.but(newton=settings.newton.squeezed()))
    return Continuation(task).begin()


def _begin_touching(task):
    """The same where peaks touch: where one way fails, another."""
    recipe = recipe_of(task.settings, task.contact)
    if not recipe.or_otherwise:
        return nested_iteration(task)

    def other(begins, way):
        def found(task):
            problem, outcome = way(task)
            return problem, replace(outcome, begins=begins) if outcome.converged else outcome

        return found

    ways = [("a film", nested_iteration)]
    if recipe.begins != DRY:
        ways.append(("the dry contact without oil", other(DRY, begin_dry)))
    return first_found(task, [*ways, ("a thick film", other(THICK_FILM, begin_thick))])


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


def begin_dry(task):
    """Solve from the dry contact, its valleys empty: near to where solids carry nearly all."""
    return nested_iteration(task.but(start=DRY))


def begin_thick(task):
    """Solve at a speed at which the film covers the peaks, and slow down: film fills the valleys.

    The valleys of the dry contact are empty; between rough lines they would fill one after the other from
    the inlet on. Solutions on the way are exact: looser ones lead to fewer answers.
    """
    faster = task.contact
    while faster.expected_film < COVERED * task.contact.roughness:
        faster = faster.at_speed(SPEED_RATIO * faster.speed)
    return Continuation(task).slow_down(*begin(replace(task, contact=faster)))
