"""The way to a solution where there is none to begin with."""

from dataclasses import replace

from mgehl.solver.continuation import SPEED_RATIO, Continuation
from mgehl.solver.journal import NOTHING_KEPT
from mgehl.solver.nested import nested_iteration
from mgehl.solver.recipe import TOUCHING, needs_a_walk, recipe_of

COVERED = 1.5
"""Film of smooth bodies over the roughness from which on a walk down in speed may begin: more than 1, or
its first solve would begin from the dry contact, too. Other values were not tried."""

NOR_FROM_A_FILM = "nor from a thick film"
"""What the reason of a failure says where both ways were tried."""


def begin(hierarchy, contact, settings, monitor, journal=NOTHING_KEPT):
    """Solve `contact` in the way that its surface, and its mean of the mobility, need; as
    `nested_iteration`."""
    if recipe_of(settings, contact).peaks == TOUCHING:
        return _begin_touching(hierarchy, contact, settings, monitor, journal)
    if not needs_a_walk(settings, contact, hierarchy.grids[-1].mesh):
        return nested_iteration(hierarchy, contact, settings, monitor, journal)
    continuation = Continuation(hierarchy, contact, settings, monitor, journal)
    return continuation.begin(contact.speed, settings.nested.start)


def _begin_touching(hierarchy, contact, settings, monitor, journal):
    """The same where peaks touch: from the dry contact, and where that fails from a thick film."""
    problem, outcome = nested_iteration(hierarchy, contact, settings, monitor, journal)
    if outcome.converged or not recipe_of(settings, contact).or_from_thick_film:
        return problem, outcome
    news = f"not found from the dry contact: {outcome.reason}; now from a thick film"

    def tell(level, cycle):
        monitor(replace(level, news=news), cycle)

    slowed, last = begin_thick(hierarchy, contact, settings, tell, journal)
    if last.converged:
        return slowed, last
    return problem, replace(outcome, reason=f"{outcome.reason}; {NOR_FROM_A_FILM}: {last.reason}")


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
