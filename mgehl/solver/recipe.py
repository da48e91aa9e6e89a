"""The recipe of a contact: every choice of its solve, and why. Nobody else decides.

    peaks       Couette flow   begins from        on              smoother                remembers
    none        3B             a full film        coarse grids    crossed lines, cliffs   nothing
    covered     3L             a full film        coarse grids    crossed lines, cliffs   corrections
    near        3L             a full film        coarse grids    lines in valleys        corrections
    touching    3L             the dry contact    the finest      lines in valleys        corrections

A film that the finest grid hardly sees begins there alone, from a thicker one (`on_mesh`). Keys of the
configuration overrule it. A contact at another speed, or as a coarser grid sees it, has a recipe of its
own.
"""

from dataclasses import dataclass, replace

from mgehl.discretization.contact_law import BoundaryFilm, InterfaceConditions
from mgehl.discretization.fluid import ARITHMETIC, FOLDING
from mgehl.discretization.scheme import Scheme
from mgehl.multigrid.cycle import CycleSettings
from mgehl.solver.settings import NewtonSettings

NONE, COVERED, NEAR, TOUCHING = "none", "covered", "near", "touching"
"""Peaks: none; below a film of `THICK`; near the other body; reaching through the film that smooth bodies
would have, where the law lets them touch."""

THICK = 2.0
"""Film that smooth bodies would have over the roughness from which on the cycle is that of smooth bodies. A
ball of lambda 1.7 takes 312 convolutions by the cycle for thin films and 644 by the other, balls of lambda
3 to 14 an eighth more."""

OF_SMOOTH, OF_ROUGH = "3B", "3L"
"""The Couette flow's schemes of smooth and of rough bodies. Behind a peak the film falls to nothing from
one node to the next; without limits it might be less than none. By 1B it stays a film, too, but on a usual
grid one that is 6 to 15 % too thick, and of a short wave twice as thick (`tests/solver/test_rough.py`)."""

FULL_FILM, UNSEEN_FILM, IN_CONTACT, A_STATE = "film", "film that the grid hardly sees", "contact", "a state"
UNDER_FILM, UNDER_THIN_FILM = "dry contact under a film", "dry contact under a thin film"
DRY, THICK_FILM = "dry contact", "thick film, slowed down"
"""First guesses: a film of the formula's thickness, or of one that the grid sees, or contact, under the
pressure of smooth bodies; another solution; the dry contact of the peaks with such a film, with nearly
none, without a fluid; and a film that covers the peaks, from which on the surfaces slow down."""

BESIDE_LAYERS = 1.0
"""The formula's film over the layers below which a start takes the dry contact as it is. A ball of 100 nm
rms with layers of 2 nm at 0.1 mm/s (half a layer): 209 convolutions for 425 from a thin film on 129 nodes.
Below 0.1 um/s it is found from the dry contact alone. At 0.6 mm/s (1.7 layers) the dry contact saves a
quarter on 129 nodes, and leads nowhere on 257."""

IDLE, IDLE_IN_TIME = 15, 30
"""Steps in a row that may gain nothing. The second number is for implicit time steps, which pass a fold
slowly and let contact spread node by node. Of 800 solves that converged, those by Newton's own steps took
at most 4 such steps. In time a film start that ends in full contact took 14, the geometric mean 15, a rough
ball of 197 nm rms 23. Films that the grid does not hold took 60 steps in vain (65 nodes, 20 and 50 mm/s);
now some 20. Contact that closes continuously has no such limit in time, nor near peaks: valleys fill and
drain node by node, and until they are done the residual stays what it is. At five speeds from 7 to .1 um/s
a ball of 105 nm rms without layers is found once with 60 steps and 1500 convolutions, and always without a
limit (129 nodes)."""

MOST_IN_TIME = 30
"""Newton steps after which a step in time is halved."""

STEEP, MOST_MORE = 19.0, 2.0
"""alpha p_h below which a step may change the pressures of smooth bodies by more, in proportion: a longer
step goes wrong because the viscosity does not follow its tangent. A pressure spike grows from grid to grid
by p_h and more, which takes many short steps: M = 20, L = 10 (alpha p_h = 10) on 1025 nodes by 3B and the
arithmetic mean 17 without this, 12 with it. With 15 to 20 as many within two; with alpha p_h from 20 on
longer steps do harm as often as good. `MOST_MORE` is how many times as much at the most: a longer step
closes the film of soft bodies, and they do not part again (without it 32 of 92 did not converge).

The pressures of rough bodies are compared with the largest one, which may be several p_h: of 37 contacts
(257 nodes) six take a third to two thirds less work by it, one 2 % more. With more besides, a ball of
294 nm rms at 0.64 m/s and 22 N does not settle on 257 nodes."""

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
    or_otherwise: bool
    """Whether it begins anew where the first way fails: from the dry contact, then at a speed whose film
    covers the peaks."""
    fluid_apart: bool
    """Whether fluid beside contact is solved at each gap by itself."""
    newton: NewtonSettings
    cycle: CycleSettings


def recipe_of(settings, contact, begins=None):
    """The `Recipe` of a loaded contact by what `SolverSettings` ask; `begins` may be `A_STATE`."""
    law, peaks = settings.scheme.contact_law, _peaks(settings.scheme.contact_law, contact)
    start = begins or settings.start
    closed = start == IN_CONTACT and law.has_contact
    touching, rough = peaks == TOUCHING, peaks != NONE
    return Recipe(
        scheme=settings.scheme,
        peaks=peaks,
        begins=_first_guess(start, law, contact) if touching else start,
        # Coarse grids do not see the peaks, and the dry contact's pressure is nearer to the answer than
        # that of any film. From the dry contact a film twice as thick as the roughness takes twice the
        # work, and one three times as thick is not found (random balls, 257 nodes).
        on_coarse_grids=start == FULL_FILM and not touching and settings.method != "relaxation",
        or_otherwise=start == FULL_FILM and touching,
        fluid_apart=closed and law.closes_faces,
        newton=_newton(settings, contact, peaks, in_time=closed or touching or start == UNSEEN_FILM),
        cycle=replace(settings.cycle, rough=rough, in_valleys=peaks in (NEAR, TOUCHING)),
    )


def recipe_in_time(settings, contact):
    """The `Recipe` of a step in time: what the surfaces carry is known beforehand.

    Where bodies part, oil that is shut in fills gaps as small as rounding: their nodes would be film and
    contact by turns for ever, with no residual to tell which.
    """
    recipe = recipe_of(settings, contact, A_STATE)
    limits = {"max_work": 10**9, "max_steps": MOST_IN_TIME, "idle_steps": MOST_IN_TIME}
    newton = replace(recipe.newton, squeeze=0.0, certain=settings.newton.tolerance, **limits)
    return replace(recipe, scheme=replace(recipe.scheme, motion=(0.0, 0.0)), newton=newton)


def _peaks(law, contact):
    if not contact.is_rough:
        return NONE
    if law.is_continuous and contact.is_mixed:
        return TOUCHING
    return NEAR if contact.expected_film < THICK * contact.roughness else COVERED


def _first_guess(start, law, contact):
    """That of peaks that touch.

    A start from contact takes the thinnest film and no node in contact. With contact everywhere, nodes
    would open and close for ever (a ball of 100 nm rms at 0.1 m/s: 60 steps without an end, 14 from the
    thin film). Where the film is thin beside the layers, solids carry nearly all.
    """
    if start in (A_STATE, DRY):
        return start
    if contact.expected_film / contact.film_scale < BESIDE_LAYERS * law.contact_gap:
        return DRY
    return UNDER_THIN_FILM if start == IN_CONTACT else UNDER_FILM


def _newton(settings, contact, peaks, in_time):
    """Newton's rules; `in_time` steps have a squeeze at the least."""
    scheme, rough = settings.scheme, contact.is_rough
    asked = settings.newton.squeezed() if in_time else settings.newton
    by_film, passes_folds = scheme.contact_law.is_continuous, scheme.may_fold or asked.squeeze > 0.0
    goes_on = by_film and (asked.squeeze > 0.0 or peaks not in (NONE, COVERED))
    idle = asked.max_steps if goes_on else IDLE_IN_TIME if passes_folds else IDLE
    return replace(
        asked,
        idle_steps=asked.idle_steps or idle,
        max_pressure_step=asked.max_pressure_step * (1.0 if rough else _more(contact)),
        over_largest=rough,
        by_film=by_film,
    )


def _more(contact):
    """How many times as much pressures may change as where the viscosity is steep; at least 1."""
    alpha_bar = contact.lubricant.pressure_viscosity * contact.pressure_scale
    return min(max(1.0, STEEP / max(alpha_bar, ALMOST_NOTHING)), MOST_MORE)


def on_mesh(settings, contact, mesh):
    """The `SolverSettings` for a mesh: where a film is asked for that it hardly sees, coarse grids tell
    nothing of that.

    Smooth bodies, and peaks under a film. Of 48 random contacts with too few cells for a start on coarse
    grids all are found in this way, with 100 convolutions on average; from higher speeds on with 249.
    """
    law = settings.scheme.contact_law
    seen = contact.matched_speed(mesh, settings.inlet_cells) == contact.speed
    otherwise = settings.scheme.face_mobility in FOLDING or settings.method == "relaxation"
    otherwise |= not law.is_continuous or _peaks(law, contact) == TOUCHING
    if settings.start != FULL_FILM or seen or otherwise:
        return settings
    return replace(settings, start=UNSEEN_FILM)


def couette_scheme_of(contact):
    """The Couette flow's scheme where none is named."""
    return OF_ROUGH if contact.is_rough else OF_SMOOTH


def interface_law(contact, layers, threshold, mean, in_time):
    """Contact that closes continuously, whose mobility vanishes and closes its faces; for who names the
    paper's mean of the mobility, contact that shuts them.

    `layers` (h_b) and `threshold` (H_th) in m. The arithmetic `mean` lets half of a node's flow through to
    a closed neighbour: such faces must be shut. Shut faces keep what touches on the way to a film: a smooth
    ball at 3.8 mm/s on 129 nodes has 324 contact nodes and no end from a film, 8227 and no end from
    contact. Closing continuously it has one film from both, after 207 and 83 convolutions. So have rough
    bodies, those with layers and those in time by every mean.
    """
    shuts = mean == ARITHMETIC and layers == 0.0 and not contact.is_rough and not in_time
    if shuts or not contact.is_loaded:
        return InterfaceConditions(threshold / contact.film_scale)
    return BoundaryFilm(max(layers, threshold) / contact.film_scale)


def share_of_the_flow(contact, scheme):
    """What flows through thin films over the flow in which residuals count: so much smaller must they be
    where the balance of every node decides what is film and what is contact: of rough bodies."""
    if not contact.is_rough or scheme.contact_law.closes_faces:
        return 1.0
    return min(max(contact.expected_film / contact.film_scale, LEAST_SHARE), 1.0)
