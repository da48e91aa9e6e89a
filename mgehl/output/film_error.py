"""The bands about a run's films, and how they came about: `error` of result.json."""

from dataclasses import dataclass, replace

from mgehl.discretization.couette import SCHEMES
from mgehl.model.contact import RESOLVED_CELLS
from mgehl.output.surface import GRIDS
from mgehl.solver.films import GridFilm
from mgehl.solver.richardson import band, band_beside, band_of_smallest

FILMS = ("central", "minimum")

BETTER = {"couette": "3B", "face_mobility": "logarithmic"}
"""The scheme whose coarser grids give the error of a film by a scheme of first order."""

ALTERNATING = "2C", "S2C"
"""Central schemes of the Couette flow, which nothing keeps from a film of two alternating ones: the nodes
that nested grids have in common are all of one."""

POISEUILLE_ORDER = 2
"""Order of the Poiseuille flow by any mean of the mobility: no film converges faster."""


@dataclass(frozen=True)
class FilmError:
    """Half-widths of the bands about the films, in nm: the limit of ever finer grids lies within. The limit
    is that on this domain: what a larger domain would change is not in the band."""

    central_nm: float | None
    """None where there is no band; `how` says why."""
    minimum_nm: float | None
    how: str
    order: int | None = None
    """Of the scheme."""
    central_order: float | None = None
    """Observed on three grids; None on two, or where the differences change their sign."""
    minimum_order: float | None = None
    grids: tuple[GridFilm, ...] = ()
    """The finest grid first."""
    convolutions: float = 0.0
    """What the coarser grids took, in equivalents of one on the finest."""


def no_band(why):
    """The `FilmError` of films without a band."""
    return FilmError(None, None, why)


UNSETTLED = "the run has not settled"
NOT_ASKED = no_band("not asked for (solver.error = false)")
OF_AN_INSTANT = no_band("the film of an instant has none")


def why_no_band(result, contact):
    """Why a `Result`'s films can have no band; empty where they may have one."""
    if contact.is_mixed:
        return "a single node of a rough surface says little; see the mean gap"
    if not result.settled:
        return UNSETTLED
    if result.edge.wrong[0]:
        return result.edge.wrong[0]
    if result.contact.nodes:
        return "there is solid contact: its edge moves from grid to grid by whole cells"
    if result.overlap.nodes:
        return "the bodies overlap"
    if result.resolution.is_the_grids:
        return "the inlet has less than a cell: the grid decides what is film"
    if result.resolution.surface == GRIDS:
        return "the surface has waves that the grid does not show"
    return ""


def why_no_band_by(problem, result):
    """Why the scheme of a `problem` gives films no band; empty where it may."""
    scheme, nm = problem.scheme, 1e9 * problem.contact.film_scale
    if scheme.couette in ALTERNATING:
        return f"by {scheme.couette} films alternate from node to node, on every grid alike"
    if not scheme.contact_law.has_contact and result.minimum_film_nm < nm * scheme.contact_law.thinnest:
        return "the film is thinner than discretization.unified_gap, by which it is made"
    return ""


def film_error(result, beside, progress):
    """The `FilmError` of a `Result`, by what is solved `Beside` it (collective). `progress` counts the
    convolutions."""
    settings = beside.settings
    why_not = why_no_band(result, beside.problem.contact) or why_no_band_by(beside.problem, result)
    if why_not or not settings.error:
        return no_band(why_not) if why_not else NOT_ASKED
    before, scheme = progress.convolutions, settings.scheme
    other = replace(scheme, **BETTER) if _order(scheme) == 1 else None
    grids = beside.films(other or scheme)
    told = from_grids(result, grids, _order(other or scheme), other)
    return replace(told, grids=grids, convolutions=progress.convolutions - before)


def _order(scheme):
    """Power of the spacing with which a film's error falls by a `Scheme`."""
    return min(SCHEMES[scheme.couette].order, POISEUILLE_ORDER)


def from_grids(result, grids, order, other=None):
    """The `FilmError` that the films of two or three `grids` tell, by a scheme of this order. The coarser
    ones may be by an`other` `Scheme`."""
    coarser = grids[1]
    if not coarser.settled or (coarser.contact_nodes and coarser.central_nm <= 0.0):
        return no_band(f"on {coarser.nodes} nodes, the next coarser grid, there is no film to compare with")
    known, unlike = [each for each in grids if each.settled], "" if other else _unlike(result, coarser)
    central, minimum = (_band(result, known, film, order, bool(unlike), other) for film in FILMS)
    halves = central.half_width, minimum.half_width
    if result.minimum_film_nm >= result.central_film_nm:
        halves = (max(halves),) * 2  # of a light load: one film, and one band
    by = f" by {other.couette} and the {other.face_mobility} mean" if other else ""
    nodes = " and ".join(str(grid.nodes) for grid in known[1:])
    how = f"from the differences to {nodes} nodes{by}, of order {order}{unlike}"
    return FilmError(*halves, how, order, central.observed_order, minimum.observed_order)


def _unlike(result, coarser):
    """Why the next coarser grid has another film, or none that shows its order, which makes the band wider,
    in words; else empty."""
    if coarser.contact_nodes:
        return f"; wider, for on {coarser.nodes} nodes the film touches at {coarser.contact_nodes}"
    if result.resolution.inlet_cells < RESOLVED_CELLS:
        return f"; wider, for the inlet has less than {RESOLVED_CELLS:g} cells"
    return ""


def _band(result, grids, film, order, unlike, other):
    reported = getattr(result, f"{film}_film_nm")
    finest, *coarser = (getattr(each, f"{film}_nm") for each in grids)
    if other:
        return band_beside(reported, coarser, order)
    if film == "minimum":
        return band_of_smallest(reported, [finest, *coarser], grids[1].spread_nm, order, unlike)
    return band(reported, [finest, *coarser], grids[1].around_nm, order, unlike)
