"""The way to a solution where there is none to begin with."""

from dataclasses import replace

from mgehl.discretization.fluid import FOLDING
from mgehl.solver.continuation import SPEED_RATIO, Continuation
from mgehl.solver.journal import NOTHING_KEPT
from mgehl.solver.nested import nested_iteration
from mgehl.solver.recipe import DRY, IN_CONTACT, THICK_FILM, TOUCHING, on_mesh, recipe_of

COVERED = 1.5
"""Film of smooth bodies over the roughness from which on a walk down in speed may begin: more than 1, or
its first solve would begin from the dry contact, too. Other values were not tried."""

FIRST_WAY = 0.75
"""Part of the work that is allowed (`solver.max_work`) at which the first way is given up. Slow balls need
most of it: of 40 (65 nodes) 33 are found with 3000 convolutions for the first way, 31 with 1500."""

NOR = "; nor from"
"""Begins, in the reason of a failure, what is said of every other way that was tried."""


def begin(hierarchy, contact, settings, monitor, journal=NOTHING_KEPT):
    """Solve `contact` in the way that its surface, and its mean of the mobility, need; as
    `nested_iteration`."""
    if recipe_of(settings, contact).peaks == TOUCHING:
        return _begin_touching(hierarchy, contact, settings, monitor, journal)
    if settings.scheme.face_mobility not in FOLDING:
        settings = on_mesh(settings, contact, hierarchy.grids[-1].mesh)
        return nested_iteration(hierarchy, contact, settings, monitor, journal)
    if settings.start == IN_CONTACT:
        settings = replace(settings, newton=settings.newton.squeezed())
        return nested_iteration(hierarchy, contact, settings, monitor, journal)
    return Continuation(hierarchy, contact, settings, monitor, journal).begin()


def _begin_touching(hierarchy, contact, settings, monitor, journal):
    """The same where peaks touch: where one way fails, another.

    Of 8 contacts that no film led to (5 rollers, 3 slow balls) 3 are found from the dry contact.
    """
    recipe = recipe_of(settings, contact)
    if not recipe.or_otherwise:
        return nested_iteration(hierarchy, contact, settings, monitor, journal)
    part = replace(settings.newton, max_work=FIRST_WAY * settings.newton.max_work)
    how = hierarchy, contact, replace(settings, newton=part)

    def other(begins, way):
        def found(tell):
            problem, outcome = way(hierarchy, contact, settings, tell, journal)
            return problem, replace(outcome, begins=begins) if outcome.converged else outcome

        return found

    ways = [("a film", lambda tell: nested_iteration(*how, tell, journal))]
    if recipe.begins != DRY:
        ways.append(("the dry contact without oil", other(DRY, begin_dry)))
    return first_found([*ways, ("a thick film", other(THICK_FILM, begin_thick))], monitor)


def first_found(ways, monitor):
    """Problem and `Outcome` of the first way that leads to an answer, each tried where those before fail.

    `ways` are (where it begins, function of a monitor). Where none leads there, the `Outcome` is the first
    one's, and has the reason of each.
    """
    (_, way), *others = ways
    problem, outcome = way(monitor)
    if outcome.converged:
        return problem, outcome
    reason = outcome.reason
    for where, way in others:
        found, last = way(_with_news(monitor, f"not found: {reason}; now from {where}"))
        if last.converged:
            return found, last
        reason += f"{NOR} {where}: {last.reason}"
    return problem, replace(outcome, reason=reason)


def _with_news(monitor, news):
    """A monitor that tells news with each level."""
    return lambda level, cycle: monitor(replace(level, news=news), cycle)


def begin_dry(hierarchy, contact, settings, monitor, journal=NOTHING_KEPT):
    """Solve from the dry contact, its valleys empty: near to where solids carry nearly all."""
    return nested_iteration(hierarchy, contact, replace(settings, start=DRY), monitor, journal)


def begin_thick(hierarchy, contact, settings, monitor, journal=NOTHING_KEPT):
    """Solve at a speed at which the film covers the peaks, and slow down: film fills the valleys on the
    way.

    The other way is from the dry contact, whose valleys are empty. Between rough lines they fill one after
    the other from the inlet on, for all must flow over the peaks. Solutions on the way are exact: of seven
    lines that are not found from the dry contact one fails with 1e-6, and a second with 1e-4.
    """
    faster = contact
    while faster.expected_film < COVERED * contact.roughness:
        faster = faster.at_speed(SPEED_RATIO * faster.speed)
    found = begin(hierarchy, faster, settings, monitor, journal)
    return Continuation(hierarchy, contact, settings, monitor, journal).slow_down(*found)
