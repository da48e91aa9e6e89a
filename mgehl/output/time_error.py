"""The bands about a run in time, its means and the state at its end: by what the next coarser grid differs.

The coarser grid marches beside in steps of two: the differences have the error of the steps as well as
the grid's. They fall with the first order, as the steps near contact and cavities do. Study `passages`
counts how many bands hold.
"""

from dataclasses import replace

import numpy as np

from mgehl.output import film_error, gap_error
from mgehl.output.files import plain_result
from mgehl.output.gap_error import half_width, share_half_width, unless_wider
from mgehl.output.quantities import QUANTITIES, told_at
from mgehl.output.result import TimeError
from mgehl.output.series import MEANS, ROUNDING, has_whole, passed
from mgehl.solver.gaps import NARROW
from mgehl.solver.pace import JUST

PRESSURE = "max_pressure_GPa"
OF_A_SPIKE = PRESSURE, "friction"
"""Columns that have no band where a spike that three nodes do not hold may be the largest: 14 of 16 bands
that were too narrow stood there. Nor have they after a reversal: long steps miss its spike."""

OF_FILMS = "central_film_nm", "minimum_film_nm"
"""Columns without bands where the inlet of smooth bodies has less than a cell: no steady film has one."""

SHARES = "load_on_contact", "load_on_solids"
"""Columns that are parts of the load."""

OPENS = 0.5
"""Part of the load by which one of these changes where contact opens or closes as a whole: its mean hangs
on when, and two grids differed by .07 where the limit was .12 off."""


def time_error(result, problem, scene, asked, progress, beside):
    """The `TimeError` of the `Result` of a run of a `Scene`, or why it has none (collective).

    `asked` whether bands are. `beside()` marches on the next coarser grid: its rows, and why there are too
    few, or "".
    """
    why_not = gap_error.why_no_band(result, problem)
    if why_not or not asked:
        return TimeError(why_not or film_error.NOT_ASKED.how)
    before, (coarser, why_not) = progress.convolutions, beside()
    if why_not:
        return TimeError(why_not)
    unseen = result.resolution.inlet_cells < gap_error.UNSEEN_CELLS
    found = from_rows(progress.rows, coarser, scene, gap_error.OF_UNSEEN if unseen else 1.0)
    if result.resolution.is_the_grids and not problem.contact.is_mixed:
        found = _without(OF_FILMS, found)
    return replace(found, convolutions=progress.convolutions - before)


def from_a_start(error, start, gone):
    """The `TimeError` of a run that begins with the film of a `start`, a `Result` or None, and has gone so
    many passages. The coarser grid begins with the same film, and learns nothing of its error in the first
    passage: there the start's bands are added, about a mean by the part of its passage that lies in the
    first. What has no band in the start has none."""
    in_first = min(1.0, 2.0 - gone)  # of the last passage
    if start is None or not (error.whole or in_first > 0.0):
        return error
    told = plain_result(start)
    central, of_start = told_at(told, QUANTITIES["central_film_nm"].band), {}
    for name in MEANS:
        missing = {"mean_gap_nm": central} | dict.fromkeys(SHARES, 0.0)  # of smooth bodies
        of_start[name] = told_at(told, QUANTITIES[name].band) or missing.get(name)

    def added(bands, part):
        if part <= 0.0:
            return bands
        known = {name: half for name, half in bands.items() if of_start[name] is not None}
        return {name: half + part * of_start[name] for name, half in known.items()}

    begun = "the run that it starts from"
    how = f"{error.how}; with those of {begun}" if central else f"{begun} has none"
    return replace(
        error, how=how, means=added(error.means, in_first), whole=added(error.whole, 1.0 / max(gone, 1.0)),
        at_the_end=added(error.at_the_end, float(gone < 1.0)),
    )  # fmt: skip


def _without(columns, error):
    """A `TimeError` without bands of some columns."""
    left = {
        name: {of: half for of, half in getattr(error, name).items() if of not in columns}
        for name in ("means", "whole", "at_the_end")
    }
    return replace(error, **left)


def from_rows(rows, coarser, scene, wider=1.0):
    """The `TimeError` that the rows of a `Scene` tell, and those of the coarser grid. Bands about all but
    the pressure are so many times `wider`, as of steady states whose inlet no grid sees."""
    gone, pairs = passed(rows, scene), list(_common(rows, coarser))
    of_passage = [pair for k, *pair in pairs if gone[k] > gone[-1] - 1.0 + ROUNDING]
    how = f"from the differences to {coarser[-1]['grid']} nodes in {len(coarser)} steps for {len(rows)}"
    if wider > 1.0:
        how += f"; {wider:g} times as wide but for the pressure: {gap_error.NO_INLET}"
    if scene.turns_round:
        how += "; none about pressure and friction, for the motion turns round"
    error = TimeError(
        how,
        means=_half_widths(of_passage, wider) if gone[-1] >= 1.0 else {},
        whole=_half_widths([pair for _, *pair in pairs], wider) if has_whole(scene) else {},
        at_the_end=_half_widths(of_passage, wider, of_last=True),
    )
    return _without(OF_A_SPIKE, error) if scene.turns_round else error


def _common(rows, coarser):
    """(Number of a row, the row, that of the coarser grid) of each instant that both have."""
    times, crumb = np.array([row["time_s"] for row in rows]), JUST * rows[-1]["time_s"]
    for row in coarser:
        k = int(np.argmin(np.abs(times - row["time_s"])))
        if abs(times[k] - row["time_s"]) <= crumb:
            yield k, rows[k], row


def _half_widths(pairs, wider, of_last=False):
    """{column: half-width} about means of pairs of rows, or about the last of them."""
    steps = np.array([row["step_s"] for _, row in pairs])
    weights, found, values = steps / steps.sum(), {}, {}
    opens = not of_last and max(np.ptp([row[name] for row, _ in pairs]) for name in SHARES) > OPENS

    def told(column):
        return float(column[-1] if of_last else weights @ column)

    for name in MEANS:
        fine, coarse = np.array([[row[name] for row in pair] for pair in pairs]).T
        # A difference that changes its sign with time is small in an instant, or on average, by chance.
        apart = float(weights @ np.abs(fine - coarse))
        values[name] = value = told(fine)
        difference = abs(value - told(coarse))
        half = _half_width(name, value, max(difference, apart), apart, 1.0 if name == PRESSURE else wider)
        found[name] = None if opens and name in SHARES else half
    central, minimum = OF_FILMS
    if found[central] and found[minimum]:  # both hang on the inlet, the smallest film on more besides
        part = found[central] / values[central]
        found[minimum] = max(found[minimum], part * values[minimum])
    crest, pressure = (np.array([row[name] for row, _ in pairs]) for name in ("pressure_crest", PRESSURE))
    if told(crest) > NARROW:
        found |= dict.fromkeys(OF_A_SPIKE)  # a spike that three nodes do not hold decides
    elif found[PRESSURE]:
        found[PRESSURE] += told(crest * pressure)
    return {name: half for name, half in found.items() if half is not None}


def _half_width(name, value, difference, apart, wider):
    """That of a column; None where two grids tell it too differently, or both that there is nothing."""
    if not apart:
        return None
    if name in SHARES:
        half = share_half_width(value, value + difference, apart)
        return half and unless_wider(wider * half, gap_error.WIDEST_SHARE)
    half = half_width(value, value + difference, apart, touches=True)
    return unless_wider(wider * half, gap_error.WIDEST * abs(value))


def with_bands(result, contact, error):
    """The `Result` of a run in time with a `TimeError`; the state at its end has bands by it."""
    films, gaps = _of_films(result, contact, error), _of_gaps(error)
    mixed = result.mixed and replace(result.mixed, error=gaps)
    return replace(
        result, time=replace(result.time, error=error), error=films, mixed=mixed,
        max_pressure_band_GPa=gaps.max_pressure_GPa,
    )  # fmt: skip


def _of_films(result, contact, error):
    """The `FilmError` of the last instant."""
    central, minimum = (error.at_the_end.get(f"{name}_film_nm") for name in film_error.FILMS)
    why_not = film_error.why_no_band(result, contact)
    if why_not or central is None:
        return film_error.no_band(why_not or _too_far(error))
    return film_error.FilmError(central, minimum, error.how)


def _of_gaps(error):
    """The `GapError` of the last instant."""
    end = error.at_the_end
    if "mean_gap_nm" not in end:
        return gap_error.no_band(_too_far(error))
    return gap_error.GapError(
        end["mean_gap_nm"], None, error.how,
        max_pressure_GPa=end.get(PRESSURE),
        contact_load_share=end.get("load_on_contact"),
        solid_load_fraction=end.get("load_on_solids"),
        friction=end.get("friction"),
    )  # fmt: skip


def _too_far(error):
    """Why a number has no band where others may have one."""
    return f"{error.how}, which are too large" if error.at_the_end else error.how
