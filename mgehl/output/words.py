"""A result in words: what a run, a `Solution` and a script print of it."""

from mgehl.output.digits import pressure_words, with_band
from mgehl.output.dry_error import no_band as no_dry_band
from mgehl.output.film_error import NOT_ASKED
from mgehl.output.films_in_words import band_words, films_words, heating_words, thinning_words
from mgehl.output.friction_result import friction_lines
from mgehl.output.mixed_words import filling_words, mixed_lines
from mgehl.output.resolution import (
    RESOLVED_CELLS,
    SEEN_CELLS,
    STANDS,
    beyond_words,
    domain_words,
    inlet_words,
)  # fmt: skip
from mgehl.output.surface import GRIDS, beyond_solids, surface_words
from mgehl.output.time_words import SPIKE, time_lines

LISTED = 20
"""Most nodes that are named one by one."""

FAILED = 'what now: configs/README.md, "It did not converge: what now?"'
UNRESOLVED = 'how to do better: configs/README.md, "Choosing the domain and the grid"'


def result_words(result, verbose=True):
    """The answer, and whether and why it can be trusted; `verbose` ones have all numbers."""
    if result.load is not None:
        lines = _bearing_lines(result)
    else:
        lines = _dry_lines(result) if result.hertz else _loaded_lines(result, verbose)
    lines = *lines, *where_to_read(result)
    return "\n".join([f"{result.verdict.upper()}: {result.reason}", *(f"  {line}" for line in lines)])


def where_to_read(result):
    """The line that says where to read on, in a list; empty where the answer can be used as it is."""
    if not result.converged:
        return [FAILED]
    is_coarse = result.resolution and result.resolution.verdict not in ("resolved", STANDS)
    is_another = result.surface and result.surface.verdict == GRIDS
    return [UNRESOLVED] if is_coarse or is_another or _contact_is_the_grids(result) else []


def _contact_is_the_grids(result):
    """Whether rough bodies touch, and grids that were compared tell no load on contact."""
    error = result.mixed and result.mixed.error
    compared = error and not result.time and error.how != NOT_ASKED.how
    return bool(compared and result.mixed.patches and error.contact_load_share is None)


def _bearing_load(result):
    """A bearing's load with its band, or why it has none."""
    band, own_unit = result.load_band_N, f"({result.load:.6g} mm)"
    if band:
        return f"{with_band(result.load_N, band)} N {own_unit}"
    why = f", no band: {result.load_band_how}" if band is None and result.converged else ""
    return f"{result.load_N:.4g} N {own_unit}{why}"  # a band of 0 is nothing on both grids


def _bearing_lines(result):
    yield (
        f"load {_bearing_load(result)}; pressure at most {result.max_pressure_MPa:.4g} MPa (P from "
        f"{result.min_P:.6g} to {result.max_P:.6g} /mm)"
    )
    if result.drag_N is not None:
        part = f", {result.drag_N / result.load_N:.3g} of the load" if result.load_N > 0.0 else ""
        rests = part and result.min_P >= 0.0  # a film that pulls has its centre anywhere
        at = f"; the load rests on x = {result.pressure_centre_mm:.4g} mm" if rests else ""
        yield f"friction on the plate {result.drag_N:.4g} N{part}, {result.drag_power_W:.4g} W{at}"
    if result.min_P < 0.0:
        yield "the film pulls where P is below 0; discretization.cavitation = true lets it tear there"
    yield (
        f"residual {result.residual:.1e}, flux imbalance {result.flux_imbalance:.1e}, "
        f"flow through closed faces {result.closed_face_flow:.1e}"
    )
    yield f"solid nodes: {result.solid_nodes}, cavitated: {result.cavitated_nodes}{filling_words(result)}"
    yield from _oil(result.mass, "film under the pad")
    yield f"work: {result.linear_iterations} iterations, {_took(result)}"


def _dry_lines(result):
    contact, hertz = result.contact, result.hertz
    error = result.dry_error or no_dry_band(NOT_ASKED.how)
    largest = pressure_words(result.max_pressure_GPa, error.max_pressure_GPa)
    yield f"largest pressure {largest}, that of Hertz {pressure_words(hertz.max_pressure_GPa)}"
    approach = with_band(result.approach_um, error.approach_um)
    approach = f"{approach} um, that of Hertz {with_band(hertz.approach_um)}"
    if result.edge.nodes_along_y is None:
        approach += " (of a line contact it counts from a distance of a: loads cannot be compared)"
    yield f"approach {approach}"
    area = _size(contact, error.area_fraction)
    yield f"contact: {area}; {_where(result)}; largest gap {contact.largest_gap_nm:.1e} nm"
    yield f"{'no band' if error.area_fraction is None else 'bands'}: {error.how}"
    surface = result.surface
    if surface and (shown := surface_words(surface.verdict, surface.wave_nodes)):
        yield f"surface: {shown}"
    yield f"load error {result.load_error:.1e}, complementarity {result.complementarity_error:.1e}"
    yield _work(result)
    yield from _overlap(result.overlap)


def _loaded_lines(result, verbose):
    resolution = result.resolution
    if result.time:
        yield from time_lines(result.time)
        yield "at the end:"
    yield f"{films_words(result)}, largest pressure {largest_pressure_words(result)}"
    yield band_words(result.error)
    yield from heating_words(result.thermal_reduction, result.is_thermally_reduced)
    if verbose:
        yield from _errors(result)
    yield from _overlap(result.overlap)
    yield from _contact(result, verbose)
    yield f"inlet: {inlet_words(resolution, advice(result))}"
    room = domain_words(resolution)
    # Nothing is known of the film of a domain that cuts the contact.
    yield f"domain: {'too small: it cuts the contact' if result.edge.cuts else room}"
    beyond = beyond_words(resolution.load_beyond_percent, at_most=bool(result.time))
    yield from (f"load: {words}" for words in beyond)
    if shown := surface_words(resolution.surface, resolution.surface_nodes):
        yield f"surface: {shown}"
    if result.mixed:
        yield from mixed_lines(result.mixed)
    yield from friction_lines(result.friction, verbose, result.is_a_spike)
    yield from thinning_words(result)
    yield _work(result)
    if verbose:
        yield from _nodes(result)


def _work(result):
    work = result.work
    return f"work: {work.convolutions:.1f} fine-grid convolutions, {work.steps} steps, {_took(result)}"


def _took(result):
    """How long it took, and on how many ranks."""
    return f"{result.wall_s:.1f} s on {result.ranks} rank{'' if result.ranks == 1 else 's'}"


def _errors(result):
    flux = "" if result.flux_imbalance is None else f", flux imbalance {result.flux_imbalance:.1e}"
    yield (
        f"residual {result.residual:.1e}, load error {result.load_error:.1e}, complementarity "
        f"{result.complementarity_error:.1e}{flux}"
    )
    per_metre = result.friction and result.friction.per_metre
    yield from _oil(result.mass, "Hertz width" if per_metre else "Hertz ellipse", per_metre)


def _oil(mass, where, per_metre=False):
    """What flows through, and what is made of it; nothing of an older result."""
    if mass:
        yield (
            f"oil: {mass.enters:.3g} m{2 if per_metre else 3}/s enter the {where}, {mass.leaves:.3g} leave "
            f"it; a node, or nodes of one kind, make at most {mass.made_share:.1e} of it"
        )


def _overlap(overlap):
    if overlap.nodes:
        yield f"THE BODIES OVERLAP at {overlap.nodes} nodes by up to {overlap.largest_nm:.2e} nm"


def _size(contact, half_width=None):
    """Nodes and area of contact, with the band about its part of the Hertz area if there is one."""
    per_cent = f"{100 * contact.area_fraction:.2f}"
    if half_width is not None:
        per_cent = with_band(100 * contact.area_fraction, 100 * half_width)
    return f"{contact.nodes} nodes, {per_cent} % of the Hertz area"


def _where(result):
    """First and last nodes of contact along the axes; of a line contact there is one."""
    contact = result.contact
    if result.edge.nodes_along_y is None:
        return f"between nodes {span(contact.x_nodes)}"
    return f"between nodes {span(contact.x_nodes)} on Y = 0, {span(contact.y_nodes)} on X = 0"


def _contact(result, verbose):
    """The solid contact, and where its pressure is below the fluid's."""
    contact, inequality, other = result.contact, result.pressure_inequality, result.other_inequality
    largest, kept = contact.largest_gap_nm, contact.kept_gap_nm
    gap = f"largest gap {largest:.1e} nm"
    if kept and contact.nodes:  # layers, or the threshold of smooth bodies
        gap = f"largest gap {largest:.4g} nm, contact keeps {kept:.4g} nm"
    yield f"contact: {_size(contact)}" + (f"; {_where(result)}; {gap}" if verbose else "")
    if verbose or inequality.violations:
        broken = f"{inequality.violations} of {inequality.checked}"
        blind = f", undecided at {_of_faces(inequality.power)}" if inequality.power.undecided else ""
        yield f"pressure inequality broken at {broken} interface nodes{blind}"
    if verbose and other.violations:
        broken = f"{other.violations} of {other.checked}"
        yield f"compared between nodes, a cell apart: broken at {broken}, by up to {other.worst:.1e} p_h"


def undecided_words(power):
    """Why the check of Eq. 2 at the interface decides nothing, by its `Power`."""
    return (
        f"not decided on this grid: at {_of_faces(power)} its tolerance is larger than contact's own "
        f"pressure, beside fluid of up to {power.fluid_pressure:.1e} p_h"
    )


def _of_faces(power):
    return f"{power.undecided} of {power.faces} faces"


def _nodes(result):
    """Nodes that break Eq. 2 or can be neither film nor contact."""
    inequality = result.pressure_inequality
    for each in inequality.nodes[:LISTED]:
        yield f"Eq. 2 violated at node ({each['i']}, {each['j']}) by {each['size']:.2e} p_h"
    for each in result.contradictions[:LISTED]:
        yield (
            f"node ({each['i']}, {each['j']}): as film its gap is {each['film_gap_nm']:.2e} nm, "
            f"as contact its pressure {each['contact_pressure']:.2e} p_h; "
            f"beside it {', '.join(each['neighbours'])}"
        )
    if inequality.violations > LISTED:
        yield f"... and at {inequality.violations - LISTED} more nodes, listed in result.json"


ADVICE = {
    STANDS: "none: the surfaces stand still, and oil is squeezed out or drawn in",
    "resolved": "resolved",
    "starved": "enough, but the domain is too small for the film",
    "coarse": f"coarse (below {RESOLVED_CELLS:g}): expect the film to change with the grid",
    "grid-determined": f"grid-determined (below {SEEN_CELLS:g}): the contact set is the grid's, "
    "not the problem's",
}

ANOTHER = "another grid or scheme has another film between the peaks, and another load on contact"
ADVICE_ROUGH = ADVICE | {
    "coarse": f"coarse (below {RESOLVED_CELLS:g}): {ANOTHER}",
    "grid-determined": f"grid-determined (below {SEEN_CELLS:g}): {ANOTHER}",
}
"""Of rough bodies, whose peaks stand where they stand on every grid that shows them."""


def advice(result):
    """What to think of an inlet, by its verdict."""
    return ADVICE_ROUGH if result.mixed else ADVICE


def largest_pressure_words(result):
    """The largest pressure of a `Result` with its band; else whether the grid holds it."""
    spike = f" ({SPIKE}: the grid's)" if result.is_a_spike else ""
    largest = pressure_words(result.max_pressure_GPa, result.max_pressure_band_GPa)
    return f"{largest}{spike}{beyond_solids(result.max_pressure_GPa)}"


def span(ends):
    """First and last node of a stretch."""
    return f"{ends[0]}..{ends[1]}" if ends else "none"
