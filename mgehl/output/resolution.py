"""How well a grid resolves the inlet, where the film is made, and what to expect of it.

A film is resolved where its inlet has cells enough and its domain is large enough.
"""

from dataclasses import dataclass
from math import isfinite, nan

from mgehl.config import COARSEST_NODES
from mgehl.model.contact import RESOLVED_CELLS
from mgehl.output import surface
from mgehl.output.domain import SUFFICIENT, UNKNOWN, domain_verdict, film_lost

SEEN_CELLS = 1.0
"""Cells in the inlet below which the contact set is the grid's, not the problem's."""

FILM_TOUCHES, CONTACT_OPENS = 1.5, 0.75
"""Cells in the inlet below which a film start has had contact, and above which a contact start has lost
full contact: `study onset` on 129 to 513 nodes, arithmetic mean."""


@dataclass(frozen=True)
class Resolution:
    """Cells in the inlet zone that builds the film, and what follows from their number."""

    inlet_cells: float
    verdict: str
    domain: str = UNKNOWN
    """Whether the domain is "sufficient" for the film, or the film "starved" by it."""
    domain_loss_percent: float = nan
    """Estimate of the film that a domain of twice the size would have more."""
    surface: str = surface.UNKNOWN
    """Whether the grid shows the surface: "smooth", "resolved", "coarse" or "grid-determined"."""
    surface_nodes: float | None = None
    """Nodes in the shortest wave of the surface; None without waves."""
    load_beyond_percent: float = 0.0
    """Of the load, what the film in the domain need not carry: of a light one more than nothing."""


def resolution(contact, mesh):
    """The `Resolution` of a loaded contact's inlet and surface by a mesh, and of its film by the domain."""
    cells, lost = contact.inlet_cells(mesh), film_lost(contact, mesh)
    domain = domain_verdict(lost)
    nodes = surface.wave_nodes(contact, mesh)
    shown = surface.surface_verdict(contact, nodes)
    found = cells, _verdict(cells, domain), domain, lost, shown, nodes if isfinite(nodes) else None
    return Resolution(*found, 100.0 * contact.share_beyond(mesh))


def _verdict(cells, domain):
    """The verdict: "resolved" needs cells in the inlet and a domain that holds it."""
    if cells >= RESOLVED_CELLS:
        return "resolved" if domain == SUFFICIENT else domain
    return "coarse" if cells >= SEEN_CELLS else "grid-determined"


def resolving_nodes(contact, mesh):
    """Nodes along each side, 2^k + 1, that give the inlet `RESOLVED_CELLS` on the domain of a mesh."""
    nodes = COARSEST_NODES
    while contact.inlet_cells(mesh) * (nodes - 1) / (mesh.nx - 1) < RESOLVED_CELLS:
        nodes = 2 * nodes - 1
    return nodes


def expectation(cells, begins_closed, is_mixed=False):
    """What a run finds with so many cells in its inlet.

    `begins_closed`: from contact whose faces are closed. `is_mixed`: peaks reach through the film.
    """
    if is_mixed:
        return "a film that the highest peaks may reach through: the run tells how much they carry"
    if cells >= RESOLVED_CELLS:
        return "a film that the grid resolves"
    if cells >= FILM_TOUCHES:
        return "a film that changes with the grid"
    if begins_closed and cells < CONTACT_OPENS:
        return "full contact, whose inlet the grid does not see"
    return "film and contact side by side; where they meet is decided by the grid"
