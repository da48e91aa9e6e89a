"""The bands about what a dry contact says: `dry_error` of result.json."""

from dataclasses import dataclass
from math import log, pi

from mgehl.discretization.axes import own
from mgehl.discretization.status import CONTACT
from mgehl.output.film_error import NOT_ASKED
from mgehl.output.gap_error import WIDEST, half_width, unless_wider
from mgehl.output.surface import GRIDS
from mgehl.solver.gaps import loads

OF_A_SIDE = (pi - 1.0 + log(2.0)) / 24.0
"""Cells that an area of nodes is too large by for each side of a cell along its edge, on the mean over all
directions and places of the edge [Yastrebov, Anciaux, Molinari 2017]. Of 64 contacts on 129 to 513 nodes,
smooth and rough, it was 0.43 to 0.95 of that."""

OF_AN_END = 0.6
"""Cells that an end of contact of a line may be off: it lies anywhere within half a cell, and twenty lines
on 129 to 2049 nodes were off by at most 0.56."""

BY_CHANCE = 1.5
"""Times the difference to the next coarser grid that the band about the approach is: by one of itself 6 of
116 were too narrow, by up to 1.42."""


@dataclass(frozen=True)
class DryError:
    """Half-widths of the bands about what a grid says: the limit of ever finer grids lies within."""

    area_fraction: float | None
    """None where there is no band; `how` says why."""
    max_pressure_GPa: float | None
    approach_um: float | None
    how: str
    convolutions: float = 0.0
    """What the coarser grid took, in equivalents of one on the finest."""


def no_band(why):
    """The `DryError` of a contact without any band."""
    return DryError(None, None, None, why)


def why_no_band(result, asked):
    """Why a dry `Result` can have no band, empty where it may; it is `asked` for by solver.error."""
    if not result.converged:
        return "the run has not converged"
    if result.surface.verdict == GRIDS:
        return "the surface is the grid's, for its shortest wave has fewer than four nodes"
    return "" if asked else NOT_ASKED.how


def dry_error(result, problem, state, coarser):
    """The `DryError` of a dry `Result`, its `problem` and `state`; `coarser` is the `OnCoarser` of the next
    grid, None where there is none (collective)."""
    area = result.contact.area_fraction * edge_error(problem, state.status) / result.contact.nodes
    of_area = "that of the area by the length of its edge"
    if coarser is None:
        return DryError(area, None, None, f"{of_area}, no others: there is no coarser grid")
    if not coarser.settled:
        return DryError(area, None, None, f"{of_area}, no others: {coarser.nodes} nodes did not settle")
    carried, GPa = loads(problem, state), 1e-9 * problem.contact.hertz.p_h
    pressure = GPa * (carried.crest + half_width(carried.largest, coarser.largest, coarser.apart))
    approach = 1e6 * BY_CHANCE * problem.contact.film_scale * abs(state.H0 - coarser.H0)
    how = f"{of_area}, others by the differences to {coarser.nodes} nodes"
    return DryError(area, unless_wider(pressure, WIDEST * result.max_pressure_GPa), approach, how)


def edge_error(problem, status):
    """How many nodes contact may be off, for its edge goes along cells (collective)."""
    grid = problem.grid
    contact = grid.halo(status == CONTACT)
    ends = [own(contact) & ~axis.beside(contact, shift) for axis in problem.axes for shift in (-1, 1)]
    return (OF_AN_END if grid.mesh.is_line else OF_A_SIDE) * sum(map(grid.count, ends))
