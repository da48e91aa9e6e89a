"""The bands about mean gaps, largest pressure and loads: of a rough contact `mixed.error` of a result."""

from dataclasses import dataclass, replace

from mgehl.output.film_error import NOT_ASKED, UNSETTLED
from mgehl.output.surface import GRIDS
from mgehl.solver.gaps import NARROW, GridGap

OF_SECOND_ORDER, OF_FIRST_ORDER = 1.0 / 3.0, 1.0
"""How many times the difference to the next coarser grid an error is, by Richardson. It is of first order
where there is contact, whose edge is known to a cell."""

ALIKE = 0.05
"""Difference over the gap from which on the order is the first: such grids do not show the second."""

SPREAD = 0.5
"""Part of the mean size of the differences from node to node that is added to the error, whose mean may be
small by chance. Chosen by 16 solves of random balls on 65 and 129 nodes, against the next finer grid."""

WIDEST = 0.5
"""Half-width over a gap or pressure from which on a band would tell nothing: there is none."""

WIDEST_SHARE = 0.25
"""The same of a part of the load."""

AT_A_SPIKE = 0.2
"""Half-width over friction from which on it has no band where the largest pressure is a spike's: of oil
whose stress nothing limits that spike may be all of it. Of 25 narrower bands one was too narrow, of 3 wider
ones two."""

OF_FEW_NODES = 0.02
"""Part of the load that so few nodes of contact carry that two grids may agree by chance: a fourth of such
parts of balls by chance on 65 and 129 nodes were farther off than these differ."""

UNSEEN_CELLS, OF_UNSEEN = 0.5, 3.0
"""Cells in the inlet below which bands are so many times as wide: where no grid sees the inlet an error is
several times the difference to the next coarser grid. Of 113 such bands of random machine contacts and
balls on 65 and 129 nodes 10 were too narrow, by 1.2 to 2.8 times, of 84 on grids of more than a cell 2.
So wide are bands of line contacts that touch, too, where all oil has to pass every ridge by a gap of a
nanometre. Of 14 to 16 about a number on 513 nodes, beside 2049 (a list of another hand), 5 about the gap by
pressure were too narrow, by up to 3.9 times; 2 about loads though so wide already, by 1.8 at the most."""

NO_INLET = "the inlet has less than half a cell"

SHARES = "contact_load_share", "solid_load_fraction"
OF_THE_FILM = "mean_nm", "loaded_nm", "friction", "rolling", *SHARES
"""Bands about parts of the load, and all that hang on the film."""

SMALLEST = 1e-4
"""Half-width at the least, over the gap or pressure, or in parts of the load."""

SHOWN = {
    "loaded_nm": "the gap by pressure",
    "max_pressure_GPa": "the largest pressure",
    "contact_load_share": "the load on contact",
    "solid_load_fraction": "the load on solids",
}
"""What has a band where the mean gap has one, and where this grid and the next coarser one are near."""


@dataclass(frozen=True)
class GapError:
    """Half-widths of the bands about what a grid says: the limit of ever finer grids lies within."""

    mean_nm: float | None
    """None where there is no band at all; `how` says why."""
    loaded_nm: float | None
    """None, as those below, also where the two grids are too far apart: then the number is the grid's."""
    how: str
    grids: tuple[GridGap, ...] = ()
    """The finest grid first."""
    convolutions: float = 0.0
    """What the coarser grid took, in equivalents of one on the finest."""
    max_pressure_GPa: float | None = None
    contact_load_share: float | None = None
    solid_load_fraction: float | None = None
    friction: float | None = None
    """Of the coefficient; None also of bodies that do not slide."""
    rolling: float | None = None
    """Of what drags each body, over the load."""

    def is_the_grids(self, name):
        """Whether a number of `SHOWN` has no band though the mean gap has one, by grids."""
        return self.mean_nm is not None and bool(self.grids) and getattr(self, name) is None

    @property
    def the_grids(self):
        """All these in words."""
        return [words for name, words in SHOWN.items() if self.is_the_grids(name)]


def no_band(why):
    """The `GapError` of a grid without any band."""
    return GapError(None, None, why)


def why_no_band(result, problem):
    """Why the mean gaps of a `Result` can have no band; empty where they may have one."""
    if not result.settled:
        return UNSETTLED
    if problem.scheme.contact_law.closes_faces:
        return "contact that closes its faces begins and ends where the grid has it"
    if result.resolution.surface == GRIDS:
        return "the surface is the grid's, for its shortest wave has fewer than four nodes"
    return result.edge.wrong[0]


def gap_error(result, beside, progress):
    """The `GapError` of a `Result`, else as `film_error.film_error`; None of smooth bodies (collective)."""
    problem = beside.problem
    if not problem.contact.roughness:
        return None
    why_not = why_no_band(result, problem)
    if why_not or not beside.settings.error:
        return no_band(why_not or NOT_ASKED.how)
    before, grids = progress.convolutions, beside.gaps()
    found = from_grids(grids)
    if result.resolution.inlet_cells < UNSEEN_CELLS:
        found = by_unseen_inlet(found, grids[0])
    elif problem.contact.is_line and max(each.contact_load_share for each in grids) > 0.0:
        found = by_ridges(found, grids[0])
    return replace(found, grids=grids, convolutions=progress.convolutions - before)


def of_films(error, beside):
    """The `GapError` of smooth bodies whose films have a `FilmError`, by what was solved `Beside` them: of
    their largest pressure and friction, for solids carry nothing (collective). Where a spike that three
    nodes do not hold may be the largest pressure, that has no band: 10 of 118 were too narrow, 9 of them
    there."""
    if error.central_nm is None:
        return no_band(error.how)
    finest, *coarser = beside.of_films()
    found = replace(from_grids((finest, *coarser)), solid_load_fraction=0.0)
    if finest.pressure_crest_GPa > NARROW * finest.max_pressure_GPa:
        friction = found.friction and unless_wider(found.friction, AT_A_SPIKE * abs(finest.friction))
        return replace(found, max_pressure_GPa=None, friction=friction)
    return found


def from_grids(grids):
    """The `GapError` that the finest grid and the next coarser one tell."""
    if len(grids) == 1:
        return no_band("there is no coarser grid")
    finest, coarser = grids
    if not coarser.settled:
        return no_band(f"on {coarser.nodes} nodes, the next coarser grid, no state settled to compare with")

    def on_both(name):
        return getattr(finest, name), getattr(coarser, name)

    touches = max(on_both("contact_load_share")) > 0.0
    mean = half_width(*on_both("mean_nm"), coarser.mean_apart_nm, touches)
    loaded = half_width(*on_both("loaded_nm"), coarser.loaded_apart_nm, touches)
    if mean > WIDEST * finest.mean_nm:
        return no_band(
            f"on {coarser.nodes} nodes the mean gap is {coarser.mean_nm:.3g} nm, too far from this"
        )
    pressure = finest.pressure_crest_GPa
    pressure += half_width(*on_both("max_pressure_GPa"), coarser.pressure_apart_GPa)

    def of_force(name, apart=0.0):
        if None in on_both(name):
            return None
        return unless_wider(half_width(*on_both(name), apart, True), WIDEST * abs(getattr(finest, name)))

    contact = share_half_width(*on_both("contact_load_share"), coarser.contact_load_apart)
    solids = share_half_width(*on_both("solid_load_fraction"), coarser.solid_load_apart)
    return GapError(
        mean,
        unless_wider(loaded, WIDEST * finest.loaded_nm),
        f"from the differences to {coarser.nodes} nodes",
        max_pressure_GPa=unless_wider(pressure, WIDEST * finest.max_pressure_GPa),
        contact_load_share=contact,
        solid_load_fraction=None if contact is None else solids,  # they carry a part of that
        friction=of_force("friction", coarser.friction_apart),
        rolling=of_force("rolling"),
    )


def by_unseen_inlet(error, finest):
    """A `GapError` of grids that do not see the inlet: all of it is wider that hangs on the film."""
    found = _wider(error, finest, OF_THE_FILM, f"but for the pressure: {NO_INLET}")
    if error.mean_nm is not None and found.mean_nm is None:
        return no_band(f"{NO_INLET}: the grid decides what is film")
    return found


def by_ridges(error, finest):
    """A `GapError` of a line contact that touches: bands about all that hangs on its ridges are wider."""
    names = "loaded_nm", "friction", *SHARES
    where = "about loads, friction and the gap by pressure: no oil flows around a ridge that touches"
    return _wider(error, finest, names, where)


def _wider(error, finest, names, where):
    """A `GapError` some of whose bands are `OF_UNSEEN` times as wide."""
    if error.mean_nm is None:
        return error
    wider = {
        name: half and OF_UNSEEN * half for name in names if (half := getattr(error, name)) is not None
    }
    kept = {name: half and unless_wider(half, _widest(name, finest)) for name, half in wider.items()}
    return replace(error, **kept, how=f"{error.how}; {OF_UNSEEN:g} times as wide {where}")


def _widest(name, finest):
    """From where on a band about a number of the finest grid tells nothing."""
    return WIDEST_SHARE if name in SHARES else WIDEST * abs(getattr(finest, name))


def half_width(value, coarser, apart, touches=False):
    """Half-width of the band about a mean gap, or the largest pressure, from the `coarser` grid's and the
    mean size of the differences between their nodes; `touches` where the edge of contact decides on it."""
    difference = abs(value - coarser)
    times = OF_FIRST_ORDER if touches or difference > ALIKE * abs(value) else OF_SECOND_ORDER
    return max(times * difference + SPREAD * apart, SMALLEST * abs(value))


def share_half_width(share, coarser, apart):
    """The same of a part of the load, with the sum of its differences; None where that tells nothing. What
    few nodes carry may be none on another grid."""
    least = share if share < OF_FEW_NODES else SMALLEST
    found = OF_FIRST_ORDER * abs(share - coarser) + SPREAD * apart
    return unless_wider(max(found, least, SMALLEST), WIDEST_SHARE)


def unless_wider(half_width, widest):
    """A half-width; None of one that tells nothing."""
    return half_width if half_width <= widest else None
