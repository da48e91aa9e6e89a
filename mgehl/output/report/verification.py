"""The part of a loaded contact's page that says whether it can be trusted: checks, contact, Eq. 2."""

from mgehl.output import surface
from mgehl.output.domain import STARVED, STARVED_FROM, SUFFICIENT, UNKNOWN
from mgehl.output.report.checks import (
    BROKEN,
    CARE,
    CHECK_HEADS,
    CHECKS,
    HOLDS,
    UNDECIDED,
    absent,
    informing,
    limited,
)
from mgehl.output.report.page import DOUBTFUL, GOOD, NO_NUMBER, Cell, number, table
from mgehl.output.report.parts import span
from mgehl.output.resolution import RESOLVED_CELLS
from mgehl.output.result import COMPLEMENTARITY_TOLERANCE
from mgehl.output.surface import RESOLVED_NODES
from mgehl.output.words import ANOTHER
from mgehl.solver.verification import FEWEST_NODES, LARGEST_EDGE_PRESSURE

RESOLUTION = {
    "resolved": Cell("resolved", GOOD),
    "starved": Cell("enough, but the domain is too small", DOUBTFUL),
    "coarse": Cell("coarse: expect the film to change with the grid", DOUBTFUL),
    "grid-determined": Cell("grid-determined: the contact set is the grid's", DOUBTFUL),
}

RESOLUTION_ROUGH = RESOLUTION | {
    verdict: Cell(f"{verdict}: {ANOTHER}", DOUBTFUL) for verdict in ("coarse", "grid-determined")
}
"""Of rough bodies."""

SURFACE = {
    surface.RESOLVED: Cell("resolved", GOOD),
    surface.COARSE: Cell("coarse", DOUBTFUL),
    surface.GRIDS: Cell("the surface is the grid's", DOUBTFUL),
}

DOMAIN = {
    SUFFICIENT: Cell("sufficient", GOOD),
    STARVED: Cell("starved: the domain takes film away", DOUBTFUL),
    UNKNOWN: Cell("not judged: made by an older version", DOUBTFUL),
}


def checks_table(solution):
    """What was checked of a solution, what it was found to be, and whether that will do."""
    result, tolerance = solution.result, solution.config.solver.tolerance
    inequality, overlap, resolution = result.pressure_inequality, result.overlap, result.resolution
    broken = f"{inequality.violations} of {inequality.checked}"
    decided = HOLDS if inequality.power.decides else UNDECIDED
    rows = [
        limited("residual of the equations, rms", result.residual, tolerance),
        limited("load error", result.load_error, tolerance),
        limited("complementarity", result.complementarity_error, COMPLEMENTARITY_TOLERANCE),
        absent("nodes that can be neither film nor contact", len(result.contradictions)),
        absent("interface nodes that break Eq. 2", inequality.violations, found=broken, holds=decided),
        absent("nodes where the bodies overlap", overlap.nodes, otherwise=CARE),
        informing("imbalance of the flux", result.flux_imbalance),
        limited(
            "pressure near the domain's boundary over the largest",
            result.edge.pressure_ratio,
            LARGEST_EDGE_PRESSURE,
        ),
        absent("nodes of the boundary where the bodies overlap", result.edge.overlapping),
        _nodes_across(result.edge),
        (
            "cells in the inlet",
            number(resolution.inlet_cells, 3),
            f"at least {RESOLVED_CELLS:g}",
            (RESOLUTION_ROUGH if result.mixed else RESOLUTION)[resolution.verdict],
        ),
        (
            "film that a domain of twice the size would have more, %, estimated",
            number(resolution.domain_loss_percent, 2),
            f"below {STARVED_FROM:g}",
            DOMAIN[resolution.domain],
        ),
        *_beyond_row(resolution.load_beyond_percent),
        *_surface_row(resolution),
    ]
    return table(CHECKS, CHECK_HEADS, rows)


def _beyond_row(percent):
    """The row about load beyond the domain, where that is counted."""
    if percent:
        yield informing("load that the film in the domain need not carry, %", percent)


def _surface_row(resolution):
    """The row about a surface that there is."""
    if resolution.surface in SURFACE:
        nodes = resolution.surface_nodes
        nodes = NO_NUMBER if nodes is None else number(nodes, 3)
        limit = f"at least {RESOLVED_NODES:g}"
        yield "nodes in the shortest wave of the surface", nodes, limit, SURFACE[resolution.surface]


def _nodes_across(edge):
    """The row of how many nodes the contact has."""
    nodes = [each for each in (edge.nodes_along_x, edge.nodes_along_y) if each is not None]
    judged = HOLDS if min(nodes) >= FEWEST_NODES else BROKEN
    return (
        "nodes that the contact is wide",
        " by ".join(map(str, nodes)),
        f"at least {FEWEST_NODES}",
        judged,
    )


def contact_tables(result):
    """Contact, then the lists of nodes that break Eq. 2 or can be neither, folded."""
    contact, inequality, other = result.contact, result.pressure_inequality, result.other_inequality
    rows = [
        ("nodes in contact", str(contact.nodes)),
        ("contact over Hertz area", number(contact.area_fraction)),
        ("part of the load on contact", number(contact.load_fraction)),
        ("contact nodes on Y = 0, counted from 1", span(contact.x_nodes)),
        ("contact nodes on X = 0, counted from 1", span(contact.y_nodes)),
        ("largest |gap| in contact, nm", number(contact.largest_gap_nm, 3)),
        *_boundary_film(contact),
        ("largest overlap outside of contact, nm", number(result.overlap.largest_nm, 3)),
        ("cavitated nodes", str(result.cavitated_nodes)),
        ("interface nodes checked on Eq. 2", str(inequality.checked)),
        (f"of them break it, compared {inequality.compared}", str(inequality.violations)),
        ("largest violation, p_h", number(inequality.worst, 3)),
        *_power(inequality.power),
        (f"of them break it, compared {other.compared}", str(other.violations)),
        ("largest violation there, p_h", number(other.worst, 3)),
        ("largest fluid over contact pressure", number(_largest_ratio(result), 3)),
    ]
    yield table(
        "Solid contact, and fluid against contact pressure across its edge", ("quantity", "value"), rows
    )
    if inequality.nodes:
        nodes = [(str(n["i"]), str(n["j"]), number(n["size"], 3)) for n in inequality.nodes]
        yield table("Nodes that break Eq. 2, counted from 1", ("i", "j", "by, p_h"), nodes, folded=True)
    if result.contradictions:
        yield _contradictions(result.contradictions)


def _power(power):
    """The row of faces at which Eq. 2 is not decided, where faces were checked."""
    if power.faces:
        what = "faces where the tolerance is larger than contact's own pressure"
        yield what, f"{power.undecided} of {power.faces}"


def _largest_ratio(result):
    """Of the fluid's pressure over the contact's: only nodes that are compared have one."""
    return max(result.pressure_inequality.largest_ratio, result.other_inequality.largest_ratio)


def _boundary_film(contact):
    """The row of the film that layers keep, where there are any."""
    if contact.kept_gap_nm:
        yield "boundary film that keeps it, nm", number(contact.kept_gap_nm, 3)


def _contradictions(nodes):
    heads = (
        "i",
        "j",
        "gap as film, nm",
        "pressure as contact, p_h",
        "beside it: west, east, before, after",
    )
    rows = [
        (str(n["i"]), str(n["j"]), number(n["film_gap_nm"], 3), number(n["contact_pressure"], 3),
         ", ".join(n["neighbours"]))
        for n in nodes
    ]  # fmt: skip
    return table("Nodes that can be neither film nor contact, counted from 1", heads, rows, folded=True)
