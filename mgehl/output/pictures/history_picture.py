"""How a run converged: residual, load and sets against its cycles, the grids marked."""

from itertools import groupby

import numpy as np
from matplotlib.ticker import MaxNLocator

from mgehl.errors import OutputError
from mgehl.kinds.loaded import speed_words
from mgehl.output.pictures.style import COLOURS, inches, subplots
from mgehl.output.pictures.titles import title

SETS = {"contact_nodes": "in contact", "cavitated_nodes": "cavitated", "changed_nodes": "changed"}
"""Columns of history.csv that count nodes, and what they are called."""
MARKED = 80
"""Cycles up to which each has a mark."""


def history(solution):
    """Figure of residual and load error, and of the sets, against the cycles in their order.

    Raises OutputError where the history lacks a column.
    """
    rows = solution.rows
    position, unit = cycles(rows)
    sets = {name: label for name, label in SETS.items() if name in rows[0]}
    panels = 2 if sets else 1
    figure, axes = subplots(panels, 1, size=(8.4, 2.0 + 2.3 * panels), sharex=True, squeeze=False)
    _draw_errors(axes[0, 0], position, rows)
    if sets:
        _draw_sets(axes[1, 0], position, rows, sets)
    for panel in axes[:, 0]:
        mark_grids(panel, position, rows)
    name_grids(axes[0, 0], position, rows, 1e3 * solution.contact.speed)
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
    what = "cycle, in order" if "load_error" in rows[0] else "linear solve"
    return np.arange(len(rows)), what


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


def mark_grids(axes, position, rows):
    """Every other grid as a grey band behind the lines."""
    ends = _ends(position)
    axes.set_xlim(ends[0], ends[-1])
    for first, last in grids(rows)[::2]:
        axes.axvspan(ends[first], ends[last + 1], color="0.94", zorder=0, linewidth=0)


def name_grids(axes, position, rows, own_speed):
    """Each grid's name above its band, as long as there is room for; the run's own speed is in mm/s."""
    ends = _ends(position)
    inch = axes.figure.get_figwidth() * 0.9 / (ends[-1] - ends[0])
    for first, last in grids(rows):
        left, right = ends[first], ends[last + 1]
        name = _longest(_names(rows[last], own_speed), inch * (right - left))
        axes.annotate(name, (0.5 * (left + right), 1.0), (0, 3), ha="center", va="bottom",
                      xycoords=axes.get_xaxis_transform(), textcoords="offset points")  # fmt: skip


def _names(row, own_speed):
    """What a grid may be called: its nodes and, where it is not the run's own, the speed."""
    nodes, speed = row["grid"], row.get("speed_mm_s")
    names = [f"{nodes} nodes", f"{nodes}", ""]
    raised = speed is not None and abs(speed / own_speed - 1.0) > 1e-6
    return [f"{nodes} nodes, {speed_words(1e-3 * speed)}", *names] if raised else names


def _longest(names, room):
    """The first of the names, longest first, that fits into so many inches of room."""
    return next(name for name in names if inches(len(name)) < room or not name)


def _ends(position):
    """Where the bands of the rows meet, (len(position) + 1,)."""
    middle = 0.5 * (position[1:] + position[:-1])
    return np.concatenate([[position[0] - 0.5], middle, [position[-1] + 0.5]])


def _draw_errors(axes, position, rows):
    _plot(axes, position, column(rows, "residual"), "o", COLOURS[0], "residual (rms)")
    if "load_error" in rows[0]:
        _plot(axes, position, np.abs(column(rows, "load_error")), "s", COLOURS[1], "|load error|")
    axes.set(yscale="log", ylabel="error, dimensionless")
    axes.legend()


def _draw_sets(axes, position, rows, sets):
    for name, colour, mark in zip(sets, (COLOURS[6], COLOURS[5], COLOURS[2]), "os^", strict=False):
        _plot(axes, position, column(rows, name), mark, colour, sets[name])
    axes.set_yscale("symlog", linthresh=1.0)
    axes.set_ylabel("number of nodes")
    axes.set_ylim(bottom=0.0)
    axes.legend()


def _plot(axes, position, values, mark, colour, label):
    mark = mark if len(position) <= MARKED else ""
    axes.plot(position, values, marker=mark, color=colour, label=label)
