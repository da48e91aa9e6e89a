"""How a run converged: residual, load and sets against its cycles, the grids marked."""

from itertools import groupby

import numpy as np
from matplotlib.ticker import MaxNLocator

from mgehl.errors import OutputError
from mgehl.kinds.loaded import speed_words
from mgehl.output.pictures.style import COLOURS, CONTACT_COLOUR, subplots
from mgehl.output.pictures.titles import title

ERRORS = {"residual": ("residual (rms)", COLOURS[0]), "load_error": ("|load error|", COLOURS[6])}
SETS = {
    "contact_nodes": ("in contact", CONTACT_COLOUR),
    "cavitated_nodes": ("cavitated", COLOURS[3]),
    "changed_nodes": ("changed", COLOURS[2]),
}
"""Columns of history.csv: what they are called, and their colours."""
NARROW = 0.15
"""Part of the axis below which a grid's name is turned: it would lie on the next one's."""


def history(solution):
    """Figure of residual and load error, and of the sets, against the cycles in their order. Raises
    OutputError where the history lacks a column."""
    rows = solution.rows
    position, unit = cycles(rows)
    needed = {"residual": ERRORS["residual"]}
    panels = [{name: shown for name, shown in ERRORS.items() if name in rows[0]} | needed,
              {name: shown for name, shown in SETS.items() if name in rows[0]}]  # fmt: skip
    panels = [columns for columns in panels if columns]
    figure, axes = subplots(len(panels), size=(8.4, 2.0 + 2.3 * len(panels)), sharex=True, squeeze=False)
    for panel, columns in zip(axes[:, 0], panels, strict=True):
        for (name, (label, colour)), mark in zip(columns.items(), "os^", strict=False):
            look = {"marker": mark, "markersize": 3, "color": colour, "label": label}
            panel.plot(position, np.abs(column(rows, name)), **look)
        panel.legend()
    axes[0, 0].set(yscale="log", ylabel="error, dimensionless")
    for panel in axes[1:, 0]:
        panel.set_yscale("symlog", linthresh=1.0)
        panel.set(ylabel="number of nodes", ylim=(0.0, None))
    _mark_grids(axes[:, 0], position, rows, 1e3 * solution.contact.speed)
    axes[-1, 0].set_xlabel(unit)
    axes[-1, 0].xaxis.set_major_locator(MaxNLocator(integer=True))
    figure.suptitle(f"convergence, {title(solution)}")
    return figure


def cycles(rows):
    """Where each row of the history stands along the axis, and the axis' label."""
    if not rows:
        raise OutputError("history.csv has no cycles")
    if "e_p" in rows[0]:
        return column(rows, "step"), "relaxation sweep"
    return np.arange(len(rows)), "cycle, in order" if "load_error" in rows[0] else "linear solve"


def column(rows, name):
    """One column of the history as an array (len(rows),). Raises OutputError where there is none."""
    try:
        return np.array([row[name] for row in rows], dtype=float)
    except (KeyError, TypeError, ValueError):
        raise OutputError(f"history.csv has no numbers in its column {name}") from None


def grids(rows):
    """First and last row of each stay on one grid at one speed."""
    column(rows, "grid")  # each has one
    stays = groupby(range(len(rows)), key=lambda k: (rows[k]["grid"], rows[k].get("speed_mm_s")))
    return [(stay[0], stay[-1]) for stay in (list(each) for _, each in stays)]


def _mark_grids(panels, position, rows, own_speed):
    """Every other grid as a grey band; its nodes above it, with the speed in mm/s where that is not the
    run's own."""
    ends = np.concatenate([[position[0] - 0.5], 0.5 * (position[1:] + position[:-1]), [position[-1] + 0.5]])
    bands, names = [(ends[first], ends[last + 1]) for first, last in grids(rows)], []
    for _, last in grids(rows):
        speed = rows[last].get("speed_mm_s") or own_speed
        raised = abs(speed - own_speed) > 1e-6 * own_speed
        names.append(f"{rows[last]['grid']} nodes" + (f", {speed_words(1e-3 * speed)}" if raised else ""))
    for panel in panels:
        panel.set_xlim(ends[0], ends[-1])
        for band in bands[::2]:
            panel.axvspan(*band, color="0.94", zorder=0, linewidth=0)
    turned = {"rotation": 30, "ha": "left", "rotation_mode": "anchor"}
    narrow = min(right - left for left, right in bands) < NARROW * (ends[-1] - ends[0])
    above = panels[0].secondary_xaxis("top")
    above.set_xticks([0.5 * sum(band) for band in bands], names, **(turned if narrow else {}))
    above.tick_params(length=0)
