"""The bands about a rough contact's mean gaps, and how they came about: `mixed.error` of result.json."""

from dataclasses import dataclass, replace

from mgehl.output.film_error import NOT_ASKED

OF_SECOND_ORDER, OF_FIRST_ORDER = 1.0 / 3.0, 1.0
"""How many times the difference to the next coarser grid a gap's error is, by Richardson."""

ALIKE = 0.05
"""Difference over the gap from which on the order is taken to be the first: grids so far apart do not show
the second yet."""

SPREAD = 0.2
"""Part of the mean size of the differences from node to node that is added to the error: their mean may be
small by chance. Of 57 random balls on 257 nodes, by which this and `ALIKE` were chosen, 55 and 56 bands
hold the limit; in the median they are 2.2 and 2.6 times as wide as the error. Of 37 others (`study gaps`)
34 and 34 do, at 3.0 and 3.7 times the error."""

WIDEST = 0.5
"""Half-width over the gap from which on a band would tell nothing: there is none."""

SMALLEST = 1e-4
"""Half-width over the gap at the least."""


@dataclass(frozen=True)
class GridGap:
    """Mean gaps of a grid in nm, and what carries its load."""

    nodes: int
    mean_nm: float
    loaded_nm: float
    contact_load_share: float
    settled: bool
    mean_apart_nm: float = 0.0
    """Mean size of the differences from the finer grid, node by node: of all nodes within the ellipse."""
    loaded_apart_nm: float = 0.0
    """The same of all nodes by their pressure."""


@dataclass(frozen=True)
class GapError:
    """Half-widths of the bands about the mean gaps, in nm: the limit of ever finer grids lies within."""

    mean_nm: float | None
    """None where there is no band; `how` says why."""
    loaded_nm: float | None
    how: str
    grids: tuple[GridGap, ...] = ()
    """The finest grid first."""
    convolutions: float = 0.0
    """What the coarser grid took, in equivalents of one on the finest."""


def no_band(why):
    """The `GapError` of gaps without a band."""
    return GapError(None, None, why)


def why_no_band(result, problem):
    """Why the mean gaps of a `Result` can have no band; empty where they may have one."""
    if not result.settled:
        return "the run has not settled"
    if problem.scheme.contact_law.closes_faces:
        return "contact that closes its faces begins and ends where the grid has it"
    return result.edge.wrong[0]


def gap_error(result, coarser, progress):
    """The `GapError` of a `Result`; None of smooth bodies (collective). Otherwise as
    `film_error.film_error`."""
    problem = coarser.problem
    if not problem.contact.roughness:
        return None
    why_not = why_no_band(result, problem)
    if why_not or not coarser.settings.error:
        return no_band(why_not or NOT_ASKED.how)
    before, nm = progress.convolutions, 1e9 * problem.contact.film_scale
    grids = tuple(_in_nm(each, nm) for each in coarser.gaps())
    return replace(from_grids(grids), grids=grids, convolutions=progress.convolutions - before)


def _in_nm(grid, nm):
    apart = (nm * grid.differences.mean, nm * grid.differences.loaded) if grid.differences else ()
    means = nm * grid.gaps.mean, nm * grid.gaps.loaded
    return GridGap(grid.nodes, *means, grid.contact_load_share, grid.settled, *apart)


def from_grids(grids):
    """The `GapError` that the gaps of the finest grid and the next coarser one tell."""
    if len(grids) == 1:
        return no_band("there is no coarser grid")
    finest, coarser = grids
    if not coarser.settled:
        return no_band(f"on {coarser.nodes} nodes, the next coarser grid, no state settled to compare with")
    mean = half_width(finest.mean_nm, coarser.mean_nm, coarser.mean_apart_nm)
    loaded = half_width(finest.loaded_nm, coarser.loaded_nm, coarser.loaded_apart_nm)
    if mean > WIDEST * finest.mean_nm or loaded > WIDEST * finest.loaded_nm:
        means = f"{coarser.mean_nm:.3g} and {coarser.loaded_nm:.3g} nm"
        return no_band(f"on {coarser.nodes} nodes the means are {means}, too far from these")
    return GapError(mean, loaded, f"from the differences to {coarser.nodes} nodes")


def half_width(gap, coarser, apart):
    """Half-width of the band about a mean `gap`, from the `coarser` grid's and the mean size of the
    differences between their nodes."""
    difference = abs(gap - coarser)
    times = OF_FIRST_ORDER if difference > ALIKE * gap else OF_SECOND_ORDER
    return max(times * difference + SPREAD * apart, SMALLEST * gap)
