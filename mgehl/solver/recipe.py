"""The recipe of a contact: every choice of its solve, and why. Nobody else decides.

    peaks       Couette flow   begins from        on              smoother                remembers
    none        3B             a full film        coarse grids    crossed lines, cliffs   nothing
    covered     3L             a full film        coarse grids    crossed lines, cliffs   corrections
    near        3L             a full film        coarse grids    lines in valleys        corrections
    touching    3L             the dry contact    the finest      lines in valleys        corrections

A film that the finest grid hardly sees begins there alone. Keys overrule the recipe. That in force is
`Task.recipe`; a contact at another speed, or as a coarser grid sees it, has its own.
"""

from dataclasses import dataclass, replace
from math import inf

from mgehl.discretization.contact_law import BoundaryFilm, InterfaceConditions
from mgehl.discretization.fluid import ARITHMETIC, MONOTONE
from mgehl.discretization.scheme import Scheme
from mgehl.multigrid.cycle import DIRECT, DIRECT_IN_TIME, CycleSettings
from mgehl.solver.settings import PASSING_TOLERANCE, NewtonSettings

NONE, COVERED, NEAR, TOUCHING = "none", "covered", "near", "touching"
"""Peaks: none; below a film of `THICK`; near the other body; reaching through the film that smooth bodies
would have, where the law lets them touch."""

THICK = 2.0
"""Film that smooth bodies would have over the roughness from which on the cycle is that of smooth bodies:
below, it takes twice the work, above, the one for thin films takes an eighth more."""

OF_SMOOTH, OF_ROUGH = "3B", "3L"
"""The Couette flow's schemes of smooth and of rough bodies: behind a peak 3B's film may be less than none.
1B's is 6 to 15 % too thick on usual grids (`tests/solver/test_rough.py`)."""

FULL_FILM, UNSEEN_FILM, IN_CONTACT, A_STATE = "film", "film that the grid hardly sees", "contact", "a state"
UNDER_FILM, UNDER_THIN_FILM = "dry contact under a film", "dry contact under a thin film"
DRY, THICK_FILM = "dry contact", "thick film, slowed down"
"""First guesses: the formula's film, or one that the grid sees, or contact, with smooth bodies' pressure;
another solution; the dry contact with such a film, nearly none, or no fluid; a film over the peaks."""

OTHER_SIDE = {FULL_FILM: IN_CONTACT, IN_CONTACT: FULL_FILM}
"""The start on the other side of each: where two states are answers, each start leads to its own."""

BESIDE_LAYERS = 1.0
"""The formula's film over the layers below which a start takes the dry contact as it is: half the work at
half a layer; at 1.7 layers it leads nowhere on 257 nodes."""

MOST_SLOWER = 2.0
"""Ratio of speeds that contact which shuts its faces is led over at once: from a film 2.3 times as fast the
first step closes constrictions, and what has touched stays long: 14 times the work, or no end."""

IDLE, IDLE_SQUEEZED = 15, 30
"""Steps in a row that may gain nothing; and so many implicit time steps, which pass a fold slowly and let
contact spread node by node: solves that converged had at most 4 and 23. Contact that closes continuously
has no such limit in time, nor near peaks: the residual stays until valleys have filled or drained."""

STEPS_IN_TIME = 30
"""Newton steps after which a step in time is halved."""

CERTAIN = 1e-11
"""Residual below which sets that change tell nothing where contact closes continuously: the gap and the
pressure of their nodes both vanish but for rounding. The verdict asks for complementarity none the less."""

STEEP, MOST_MORE = 19.0, 2.0
"""alpha p_h below which a step may change the pressures of smooth bodies by more, in proportion, and how
many times as much at the most: the viscosity follows its tangent farther, and spikes grow by p_h from grid
to grid. From 20 on longer steps do harm as often as good; without a most, soft bodies close for good.

Pressures of rough bodies are compared with the largest one, which may be several p_h; more than that fails.
"""

LEAST_SHARE = 1e-2
"""Least part of the tolerance that a thin film asks for: less comes near to rounding."""

ALMOST_NOTHING = 1e-300
"""So that nothing is divided by zero."""


@dataclass(frozen=True)
class Recipe:
    """All choices of the solve of one contact."""

    scheme: Scheme
    peaks: str
    begins: str
    """Its first guess."""
    on_coarse_grids: bool
    """Whether it begins on coarse grids, at speeds that they resolve."""
    most_slower: float
    """Ratio of speeds that it is led over at once."""
    otherwise: tuple
    """First guesses from which it begins anew, one after the other, where the first leads nowhere."""
    newton: NewtonSettings
    patient: NewtonSettings
    """Newton's rules where those lead nowhere: the same by time steps."""
    cycle: CycleSettings


def recipe_on(mesh, settings, contact):
    """The `Recipe` of a loaded contact by what `SolverSettings` ask on its finest mesh. Where that hardly
    sees the film that is asked for, coarse grids tell nothing. Smooth bodies, and peaks under a film; from
    higher speeds on they take twice the work."""
    recipe, scheme = recipe_of(settings, contact, settings.start), settings.scheme
    may_be_unseen = recipe.on_coarse_grids and scheme.contact_law.is_continuous and not scheme.may_fold
    if may_be_unseen and contact.matched_speed(mesh, settings.inlet_cells) != contact.speed:
        return recipe_of(settings, contact, UNSEEN_FILM)
    return recipe


def recipe_of(settings, contact, start):
    """The same from one of the first guesses."""
    law, peaks = settings.scheme.contact_law, _peaks(settings.scheme.contact_law, contact)
    closed = start == IN_CONTACT and law.has_contact
    touching, rough = peaks == TOUCHING, peaks != NONE
    guess = _first_guess(start, law, contact) if touching else start
    return Recipe(
        scheme=settings.scheme,
        peaks=peaks,
        begins=guess,
        # Coarse grids do not see the peaks, and the dry contact's pressure is nearer to the answer than
        # that of any film. From the dry contact a film twice as thick as the roughness takes twice the
        # work, and one three times as thick is not found (random balls, 257 nodes).
        on_coarse_grids=start == FULL_FILM and not touching and settings.by_newton,
        most_slower=MOST_SLOWER if law.closes_faces else inf,
        otherwise=_otherwise(settings, start, guess, touching),
        newton=_newton(settings, contact, peaks, squeezed=closed or touching or start == UNSEEN_FILM),
        patient=_newton(settings, contact, peaks, squeezed=True),
        cycle=replace(
            settings.cycle, direct=DIRECT if rough else 0, rough=rough, in_valleys=peaks in (NEAR, TOUCHING)
        ),
    )


def recipe_in_time(settings, contact):
    """The `Recipe` of a step in time: what the surfaces carry is known. Sets may still change in its last
    Newton step: the residual is that of the sets after it. Where bodies part, shut-in oil fills gaps as
    small as rounding, whose nodes would change for ever."""
    recipe = recipe_of(settings, contact, A_STATE)
    limits = {"max_work": 10**9, "max_steps": STEPS_IN_TIME, "idle_steps": STEPS_IN_TIME}
    limits |= {"by_reduced_pressure": recipe.scheme.face_mobility in MONOTONE}
    newton = replace(
        recipe.newton,
        squeeze=0.0,
        eliminates=False,
        passes_on=False,
        in_time=True,
        certain=PASSING_TOLERANCE,
        **limits,
    )
    cycle = replace(recipe.cycle, direct=max(recipe.cycle.direct, DIRECT_IN_TIME))
    return replace(recipe, scheme=replace(recipe.scheme, motion=(0.0, 0.0)), newton=newton, cycle=cycle)


def _peaks(law, contact):
    if not contact.is_rough:
        return NONE
    if law.is_continuous and contact.is_mixed:
        return TOUCHING
    return NEAR if contact.expected_film < THICK * contact.roughness else COVERED


def _first_guess(start, law, contact):
    """That of peaks that touch: the thinnest film and no node in contact, for with contact everywhere nodes
    would open and close for ever. Where the film is thin beside the layers, solids carry nearly all."""
    if start not in OTHER_SIDE:
        return start
    if contact.expected_film / contact.film_scale < BESIDE_LAYERS * law.contact_gap:
        return DRY
    return UNDER_THIN_FILM if start == IN_CONTACT else UNDER_FILM


def _otherwise(settings, start, guess, touching):
    """What else to begin from. Contact that shuts its faces may have an answer on the side of the film, or
    of contact, alone."""
    if touching and start == FULL_FILM:
        return tuple(each for each in (DRY, THICK_FILM) if each != guess)
    law = settings.scheme.contact_law
    shuts = law.closes_faces and law.has_contact and settings.by_newton
    return (OTHER_SIDE[start],) if shuts and start in OTHER_SIDE else ()


def _newton(settings, contact, peaks, squeezed):
    """Newton's rules; `squeezed` steps have a squeeze at the least."""
    scheme, rough = settings.scheme, contact.is_rough
    asked = (settings.squeezed() if squeezed else settings).newton
    by_film, passes_folds = scheme.contact_law.is_continuous, scheme.may_fold or asked.squeeze > 0.0
    goes_on = by_film and (asked.squeeze > 0.0 or peaks not in (NONE, COVERED))
    idle = asked.max_steps if goes_on else IDLE_SQUEEZED if passes_folds else IDLE
    return replace(
        asked,
        idle_steps=asked.idle_steps or idle,
        max_pressure_step=asked.max_pressure_step * (1.0 if rough else _more(contact)),
        over_largest=rough,
        by_film=by_film,
        certain=max(asked.certain, CERTAIN if by_film else 0.0),
        # A line's systems are solved directly: a step of all takes no longer than windows would.
        eliminates=peaks == TOUCHING and not contact.is_line,
        # Of 44 rollers one gained by that and one was lost.
        passes_on=peaks == TOUCHING and not contact.is_line and not scheme.contact_law.leaks,
        by_reduced_pressure=peaks != TOUCHING and scheme.face_mobility in MONOTONE,
    )


def _more(contact):
    """How many times as much pressures may change as where the viscosity is steep; at least 1."""
    alpha_bar = contact.lubricant.pressure_viscosity * contact.pressure_scale
    return min(max(1.0, STEEP / max(alpha_bar, ALMOST_NOTHING)), MOST_MORE)


def couette_scheme_of(contact):
    """The Couette flow's scheme where none is named."""
    return OF_ROUGH if contact.is_rough else OF_SMOOTH


def interface_law(contact, layers, threshold, mean, in_time):
    """Contact that closes continuously, whose mobility vanishes and closes its faces; for who names the
    paper's mean of the mobility, contact that shuts them. `layers` (h_b) and `threshold` (H_th) in m.

    The arithmetic `mean` lets half of a node's flow through to a closed neighbour, so its faces must be
    shut. Shut faces keep what touches on the way to a film: smooth balls then find no end, from film or
    from contact. Rough bodies, those with layers and those in time close continuously by every mean.
    """
    shuts = mean == ARITHMETIC and layers == 0.0 and not contact.is_rough and not in_time
    if shuts or not contact.is_loaded:
        return InterfaceConditions(threshold / contact.film_scale)
    return BoundaryFilm(max(layers, threshold) / contact.film_scale, leaks=layers > threshold)


def share_of_the_flow(contact, scheme):
    """What flows through thin films over the flow in which residuals count: so much smaller must they be
    where the balance of every node decides what is film and what is contact: of rough bodies."""
    if not contact.is_rough or scheme.contact_law.closes_faces:
        return 1.0
    return min(max(contact.expected_film / contact.film_scale, LEAST_SHARE), 1.0)
