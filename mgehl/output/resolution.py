"""Whether a grid resolves the inlet, where the film is made, and a domain is large enough for it, by a
formula's film alone: `mgehl check` and the run say the same words."""

from dataclasses import dataclass, replace
from itertools import product
from math import nan

from mgehl.config import COARSEST_NODES
from mgehl.kinds.loaded import speed_words
from mgehl.model.contact import RESOLVED_CELLS
from mgehl.model.far_field import MOST
from mgehl.model.peaks import reach_of_peaks
from mgehl.model.starvation import Starvation
from mgehl.output import surface
from mgehl.solver.verification import FEWEST_NODES

SEEN_CELLS = 1.0
"""Cells in the inlet below which the contact set is the grid's, not the problem's."""

FILM_TOUCHES, CONTACT_OPENS = 1.5, 0.75
"""Cells in the inlet below which film starts had contact with shut faces; above, contact starts lost it."""

FILM_IS_THE_GRIDS = 0.5
"""Cells below which films of contact that closes continuously touch by the grid, on 257 nodes."""

STARVED_FROM = 1.0
"""A domain starves its film from so many per cent on that a domain of twice the size would have more."""

SUFFICIENT, STARVED = "sufficient", "starved"
"""Verdicts on a domain."""

STANDS = "standing"
"""Verdict on an inlet and a domain of surfaces that stand still: no formula knows their film."""


@dataclass(frozen=True)
class Resolution:
    """Cells in the inlet zone that builds the film, and what follows from their number."""

    inlet_cells: float
    """nan where the surfaces stand still throughout."""
    verdict: str
    domain: str = SUFFICIENT
    """Whether the domain is "sufficient" for the film, or the film "starved" by it."""
    domain_loss_percent: float = nan
    """Estimate of the film that a domain of twice the size would have more."""
    surface: str = surface.SMOOTH
    """Whether the grid shows the surface: "smooth", "resolved", "coarse" or "grid-determined"."""
    surface_nodes: float | None = None
    """Nodes in the shortest wave of the surface; None without waves."""
    load_beyond_percent: float = 0.0
    """Of the load, what the film in the domain need not carry: of a light one more than nothing."""
    inlet_speed: float | None = None
    """In m/s, that of the inlet where the speed changes with time; None elsewhere."""
    rests: bool = False
    """Whether the surfaces come to rest, where no grid resolves the inlet."""
    nodes_at_rest: float | None = None
    """Cells across the contact in which the bodies stand then; None elsewhere."""

    @property
    def is_the_grids(self):
        """Whether the grid decides what is film: the inlet has less than a cell."""
        return self.verdict == "grid-determined"


def inlet_cells(contact, mesh, scene=None):
    """Cells of a mesh in the inlet of a loaded contact; of a `Scene` the fewest of its slowest motion."""
    if scene is None:
        return contact.inlet_cells(mesh)
    slow = scene.in_all_directions(contact, scene.slowest)
    return min(there.inlet_cells(mesh) * (there.x_scale / contact.x_scale) for there in slow)


def inlet_cells_of(contact, mesh, film):
    """Cells in the inlet of a contact whose central film in m is known: no more than formulas say. What
    shear thins has fewer, and formulas do not know of it."""
    known = contact.inlet_cells(mesh)
    if not contact.friction.thins or not film > 0.0:
        return known
    length = contact.inlet_length_of(film * contact.density_ratio)
    return min(known, length / contact.cell_along_motion(mesh))


def resolution(contact, mesh, scene=None, film=None):
    """The `Resolution` of a loaded contact's inlet and surface by a mesh, and of its film by the domain;
    with the central film in m of a steady state that is known.

    Of a `Scene` the contact is that at a time of 0, the inlet that of the slowest motion, and the domain is
    judged at the instant that it takes most from.
    """
    shown = surface.SurfaceOnGrid.of(contact, mesh)
    seen = shown.verdict, shown.wave_nodes
    if scene is not None and scene.stands:  # no motion builds a film
        return Resolution(nan, STANDS, STANDS, nan, *seen)
    by_formula = film is None or scene is not None
    cells = inlet_cells(contact, mesh, scene) if by_formula else inlet_cells_of(contact, mesh, film)
    lost = film_lost(contact, mesh, scene)
    beyond = load_beyond(contact, mesh, scene)
    domain = STARVED if _is_most(beyond) or lost >= STARVED_FROM else SUFFICIENT
    verdict = "coarse" if cells >= SEEN_CELLS else "grid-determined"
    if cells >= RESOLVED_CELLS:
        verdict = "resolved" if domain == SUFFICIENT else domain
    found = Resolution(cells, verdict, domain, lost, *seen, beyond)
    if scene is None or scene.is_steady:
        return found
    across = 2.0 / (mesh.dX if mesh.is_line else max(mesh.dX, mesh.dY))
    return replace(
        found, inlet_speed=abs(scene.speed.value(scene.slowest)), rests=scene.rests,
        nodes_at_rest=across if scene.rests else None,
    )  # fmt: skip


def inlet_speed_words(resolution):
    """Of which speed the inlet is; empty where the speed stays."""
    if resolution.inlet_speed is None:
        return ""
    return f"at {'' if resolution.rests else 'the slowest, '}{speed_words(resolution.inlet_speed)}"


def of_inlet(resolution):
    """The same after another word."""
    return f" {inlet_speed_words(resolution)}".rstrip()


def near_rest(resolution):
    """What else to think of an inlet whose surfaces come to rest, and of the contact they stand in."""
    few, cells = resolution.nodes_at_rest, ""
    if few and few < FEWEST_NODES:
        cells = f", and the contact has {few:.1f} cells across there, too few for a verdict"
    return f"; near rest no grid resolves it{cells}" if resolution.rests else ""


def inlet_words(resolution, advice):
    """Cells in the inlet, of which speed they are, and what to think of them."""
    if resolution.verdict == STANDS:
        return advice[STANDS]
    cells = f"{resolution.inlet_cells:.2f} cells{of_inlet(resolution)}"
    return f"{cells}, {advice[resolution.verdict]}{near_rest(resolution)}"


def resolving_nodes(contact, mesh, scene=None):
    """Nodes along each side, 2^k + 1, that give the inlet `RESOLVED_CELLS` on the domain of a mesh."""
    cells = inlet_cells(contact, mesh, scene) * (COARSEST_NODES - 1) / (mesh.nx - 1)
    return surface.refined(COARSEST_NODES, cells, RESOLVED_CELLS)


def expectation(cells, from_film, is_mixed, shuts):
    """What a run finds with so many cells in its inlet, by its start. `is_mixed`: peaks reach through the
    film. `shuts`: contact shuts its faces."""
    if is_mixed:
        return "a film that the highest peaks may reach through: the run tells how much they carry"
    if cells >= RESOLVED_CELLS:
        return "a film that the grid resolves"
    if cells >= (FILM_TOUCHES if shuts else FILM_IS_THE_GRIDS):
        return "a film that changes with the grid"
    if not shuts:
        return "a film that the grid does not see: it and any contact are the grid's"
    if not from_film and cells < CONTACT_OPENS:
        return "full contact, whose inlet the grid does not see"
    return "film and contact side by side; where they meet is decided by the grid"


def film_lost(contact, mesh, scene=None):
    """Estimate, in per cent, of the film that a domain of twice the size would have more. Of central and
    minimum film the one that changes more; good to a factor of two. Of a `Scene` the most."""
    return max(
        Starvation(there, there.flooded_film).lost(*there.in_its_units(*contact.ends(mesh, sense)))
        for there, sense in _instants(contact, scene)
    )


def load_beyond(contact, mesh, scene=None):
    """Part of the load, in per cent, that the film in the domain of a mesh need not carry, below 0 what it
    carries more. Of a `Scene` the most that an instant has."""
    return 100.0 * max(
        (there.share_beyond(*contact.ends(mesh, sense)) for there, sense in _instants(contact, scene)),
        key=abs,
    )


def _instants(contact, scene):
    """Contacts, and the sense of their motion: the contact itself; of a `Scene` those of its extremes, in
    each direction and either sense."""
    if scene is None:
        return [(contact, 1.0)]
    there = (each for t in scene.extremes for each in scene.in_all_directions(contact, t))
    return list(product(there, scene.senses))


def domain_words(resolution):
    """The verdict on a domain and its estimate in words."""
    verdict, lost = resolution.domain, resolution.domain_loss_percent
    if verdict == STANDS:
        return "of a point contact what is squeezed out beyond it is counted, as between rigid bodies"
    if verdict == SUFFICIENT:
        return f"sufficient: twice the size would change the film by some {lost:.1f} %"
    much = "far more than" if _is_most(resolution.load_beyond_percent) else "some"
    return (
        f"starved: twice the size would change the film by {much} {lost:.2g} %; "
        'grid.x = "auto" and grid.y = "auto" choose one as large as the nodes allow, up to 1000 a'
    )


def _is_most(percent):
    """Whether so much of the load is missing as is ever reckoned: the domain cuts the film itself, and what
    is reckoned of either is too little."""
    return percent >= 100.0 * MOST


def beyond_words(percent, at_most=False):
    """How much of the load the film in a domain need not carry, in a list; empty where hardly any.
    `at_most`: of the instants of a run in time."""
    least = "at least " if _is_most(percent) else ""
    part = f"{'up to ' if at_most and not least else least}{abs(percent):.1f} % of it"
    words = f"{part} is carried beyond the domain or lost at its sides, the rest within"
    if percent < 0.0:
        words = f"{part} more is carried within: behind the domain, film that is not torn sucks"
    return [words] if abs(percent) >= 0.05 else []


def peaks_words(contact, mesh):
    """How far out peaks may touch, in a list; empty where the domain of a mesh holds them."""
    reach = reach_of_peaks(contact, contact.flooded_film)
    sides = zip(reach, (mesh.x,) if mesh.is_line else (mesh.x, mesh.y), "ab", strict=False)
    outside = [f"{peak:.2f} {unit}" for peak, ends, unit in sides if peak > min(-ends[0], ends[1])]
    if not outside:
        return []
    return [f"peaks may touch up to {' and '.join(outside)} from the centre, outside of it"]


def room_words(mesh):
    """The ends of a domain."""
    x = f"x from {mesh.x[0]:g} to {mesh.x[1]:g} a"
    return x if mesh.is_line else f"{x}, y from {mesh.y[0]:g} to {mesh.y[1]:g} b"
