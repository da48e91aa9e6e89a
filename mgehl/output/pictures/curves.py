"""Numbers of runs against a key of their configurations: films, what carries the load, friction."""

from collections import defaultdict
from math import isfinite
from typing import NamedTuple

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

from mgehl.config import KEYS
from mgehl.errors import UserError
from mgehl.kinds.choice import value_of
from mgehl.kinds.derived import beside
from mgehl.kinds.kind import pressure_unit
from mgehl.output.pictures.style import COLOURS, MARKS, legend_under_all, subplots
from mgehl.output.pictures.titles import DOMAIN, differing, key_words
from mgehl.output.quantities import QUANTITIES

PANELS = {
    "film, nm": ("mean_gap_nm", "central_film_nm", "minimum_film_nm"),
    "part of the load": ("load_on_solids", "load_on_contact"),
    "friction coefficient": ("friction", "friction_of_film", "friction_of_solids"),
    "largest pressure, GPa": ("max_pressure_GPa",),
    "load, N": ("bearing_load_N",),
    "largest pressure, MPa": ("bearing_pressure_MPa",),
    "rise of temperature, K": ("flash_1_K", "flash_2_K", "film_K"),
}
"""Axis of each panel and what it shows: each its own stroke."""

STROKES = "-", "--", ":"

OF_ONE_NODE = "central_film_nm", "minimum_film_nm"
"""Left out where there is a mean gap: a single node of a rough surface says little."""

MIXED = 0.01, 0.9
"""Part of the load on solids from which on, and up to which, lubrication is called mixed."""

DECADE = 10.0
"""Largest over smallest value from which on an axis is logarithmic."""

FEW = 100.0
"""Largest over smallest value up to which a logarithmic axis has numbers between the powers of ten."""

ROOM = 1.05
"""Top of an axis over the largest value: values that are all alike would lie on the edge."""

NOT_HERE = {"color": "0.4", "marker": "|", "linestyle": "none", "markersize": 10}
"""On the upper edge, where a run has no answer."""

HOLLOW = "white"
"""Face of a point without a band that others of its kind have: it is the grid's."""


class Group(NamedTuple):
    """Runs that differ in the key alone, or have a name in common, and their look."""

    runs: list
    colour: str
    mark: str


def curves(runs, key, names=()):
    """Figure of `Told` runs against a key: a colour for what else differs, or for `names` of the runs.

    Bands are bars; a point without a band that others of its kind have is hollow: it is the grid's. Raises
    UserError where there is nothing to draw.
    """
    panels = _panels(runs, key)
    groups = _groups(runs, key, names)
    rows = (len(panels) + 1) // 2
    figure, axes = subplots(rows, min(2, len(panels)), size=(10.5, 1.0 + 3.4 * rows), squeeze=False)
    for axis, (label, panel) in zip(axes.flat, panels.items(), strict=False):
        _draw_panel(axis, runs, groups, key, label, panel)
        shade = _shade_mixed(axis, runs, key, "" if len(groups) == 1 else ", on some of the curves")
    for axis in axes.flat[len(panels) :]:
        axis.remove()
    if handles := _handles(axes.flat[0], groups) + _hollow(figure) + [shade] * bool(shade):
        legend_under_all(figure, handles)
    failed = sum(not run.settled for run in runs)
    note = f", {failed} without an answer (ticks above)" if failed else ""
    figure.suptitle(f"{len(runs)} runs against {key}{note}")
    return figure


def _panels(runs, key):
    """{label: quantities} of the panels that have something to show. Raises UserError where none has."""
    x = [run.value(key) for run in runs]
    if any(isinstance(each, bool) or not isinstance(each, int | float) for each in x):
        raise UserError(f"--against {key}: has no number in each of these runs")
    if len(set(x)) < 2:
        raise UserError(f"--against {key}: is {x[0]:g} in all of these runs")
    panels = {label: _there(runs, panel) for label, panel in PANELS.items()}
    panels = {label: panel for label, panel in panels.items() if panel}
    if not panels:
        raise UserError(f"--against {key}: none of these runs has an answer to draw")
    return panels


def _handles(axis, groups):
    """Of the groups' colours, for a legend; none of a single group."""
    if len(groups) == 1:
        return []
    return [axis.plot([], [], color=each.colour, label=name)[0] for name, each in groups.items()]


def _hollow(figure):
    """Of points without a band, for a legend; none where all have one."""
    lines = [line for axis in figure.axes for line in axis.lines if line.get_markerfacecolor() == HOLLOW]
    there = any(np.isfinite(line.get_ydata()).any() for line in lines)
    look = {"marker": "o", "markerfacecolor": HOLLOW, "linestyle": "none", "color": "0.4"}
    return [Line2D([], [], label="no band: the grid's", **look)] * there


def _draw_panel(axis, runs, groups, key, label, panel):
    """The quantities of a panel of all runs against the key."""
    x = [run.value(key) for run in runs]
    y = [run.number(QUANTITIES[name].path) for run in runs if run.settled for name in panel]
    factor, unit = pressure_unit(max(filter(isfinite, y))) if label.endswith("GPa") else (1.0, "")
    handles = [_draw_group(axis, group, key, panel, factor) for group in groups.values()]
    told = [each for each in (key, KEYS[key].metadata["unit"]) if each]
    axis.set(ylabel=_label(label.replace("GPa", unit), panel), xlabel=", ".join(told))
    _scale(axis, x, [factor * each for each in y])
    failed = [each for each, run in zip(x, runs, strict=True) if not run.settled]
    axis.plot(failed, len(failed) * [0.98], transform=axis.get_xaxis_transform(), **NOT_HERE)
    if len(panel) > 1:
        axis.legend(handles=handles[0])


def _shade_mixed(axis, runs, key, where):
    """Grey where some run along the key is in mixed lubrication, up to halfway to the next one that is not;
    None where none is."""
    solids, settled = QUANTITIES["load_on_solids"].path, [run for run in runs if run.settled]
    mixed = [run.value(key) for run in settled if MIXED[0] <= run.number(solids) <= MIXED[1]]
    if not mixed:
        return None
    there = sorted({run.value(key) for run in settled})
    first, last = there.index(min(mixed)), there.index(max(mixed))
    ends = there[max(first - 1, 0)], min(mixed), max(mixed), there[min(last + 1, len(there) - 1)]
    is_log = axis.get_xscale() == "log"
    middle = [(a * b) ** 0.5 if is_log else 0.5 * (a + b) for a, b in (ends[:2], ends[2:])]
    label = f"mixed: solids carry {MIXED[0]:.0%} to {MIXED[1]:.0%}{where}"
    return axis.axvspan(*middle, color="0.92", zorder=0, label=label)


def _label(label, panel):
    """Of a panel's axis: that of the only quantity, or what all have in common."""
    if len(panel) > 1:
        return label
    return ", ".join([QUANTITIES[panel[0]].meaning, *label.split(", ")[1:]])


def _groups(runs, key, names):
    """{what runs have in common but the key: their `Group`}, in order. Of a key that follows from words the
    other numbers that follow from them are told, and not the words."""
    numbers, words = beside(key) if any(value_of(run.tables, key) is None for run in runs) else ((), ())
    differ = [
        each for each in differing([run.tables for run in runs]) if each not in (key, *words, *DOMAIN)
    ]
    differ += [
        each for each in numbers if each not in differ and len({run.value(each) for run in runs}) > 1
    ]
    found = defaultdict(list)
    for number, run in enumerate(runs):
        said = [key_words(each, run.value(each)) for each in differ if run.value(each) is not None]
        found[", ".join([*said, *names[number : number + 1]])].append(run)
    looks = zip(found.values(), COLOURS * len(found), MARKS * len(found), strict=False)
    return {name: Group(*look) for name, look in zip(found, looks, strict=False)}


def _there(runs, panel):
    """Quantities of a panel that say something of some run."""
    numbers = {name: [run.number(QUANTITIES[name].path) for run in runs if run.settled] for name in panel}
    found = [name for name, values in numbers.items() if any(isfinite(each) and each for each in values)]
    return [name for name in found if name not in OF_ONE_NODE or "mean_gap_nm" not in found]


def _draw_group(axis, group, key, panel, factor):
    """The curves of one group, by their numbers times a factor; their handles."""
    settled = sorted((run for run in group.runs if run.settled), key=lambda run: run.value(key))
    _, colour, mark = group
    handles = []
    for quantity, stroke in zip(panel, STROKES, strict=False):
        path, _, meaning, band = QUANTITIES[quantity]
        at = np.array([run.value(key) for run in settled])
        y = factor * np.array([run.number(path) for run in settled])
        width = factor * np.array([run.number(band or "none") for run in settled])
        (line,) = axis.plot(at, y, stroke, color=colour, label=meaning)
        handles.append(line)
        bare = np.isnan(width) & np.isfinite(width).any()
        for part, face in ((~bare, colour), (bare, HOLLOW)):
            axis.plot(at[part], y[part], mark, color=colour, markerfacecolor=face)
        if np.isfinite(width).any():
            axis.errorbar(at, y, np.where(bare, 0.0, width), fmt="none", ecolor=colour, capsize=2)
    return handles


def _scale(axis, x, y):
    """Logarithmic axes where values go over a decade; where some are zero, linear."""
    for name, values in (("x", x), ("y", y)):
        values = [each for each in values if isfinite(each)]
        if values and min(values) > 0.0 and max(values) >= DECADE * min(values):
            axis.set(**{f"{name}scale": "log"})
            if max(values) < FEW * min(values):
                ticks = getattr(axis, f"{name}axis")
                ticks.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
                ticks.set_major_formatter(lambda value, _: f"{value:g}")
                ticks.set_minor_formatter(NullFormatter())
        elif name == "y":
            top = max([axis.get_ylim()[1], *(ROOM * each for each in values)])
            axis.set_ylim(min([0.0, *values]), top)
