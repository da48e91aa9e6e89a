"""How a run converged: residual, load and sets against its cycles, the grids marked."""

from itertools import groupby

import numpy as np

from mgehl.errors import OutputError
from mgehl.output.style import COLOURS, subplots
from mgehl.output.titles import title

SETS = {"contact_nodes": "in contact", "cavitated_nodes": "cavitated", "changed_nodes": "changed"}
"""Columns of history.csv that count nodes, and what they are called."""


def history(solution):
    """Figure of residual and load error, and of the sets, against the cycles in their order."""
    rows = solution.rows
    sets = [name for name in SETS if name in rows[0]]
    panels = 2 if sets else 1
    figure, axes = subplots(panels, 1, size=(8.4, 2.0 + 2.3 * panels), sharex=True, squeeze=False)
    position, unit = cycles(rows)
    _draw_errors(axes[0, 0], position, rows)
    if sets:
        _draw_sets(axes[1, 0], position, rows, sets)
    for k, panel in enumerate(axes[:, 0]):
        mark_grids(panel, position, rows, named=k == 0)
    axes[-1, 0].set(xlabel=unit)
    figure.suptitle(title(solution))
    return figure


def cycles(rows):
    """Where each row of the history stands along the axis, and the axis' label."""
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
    """Consecutive rows on one grid: (nodes, first row, last row) of each."""
    nodes = column(rows, "grid").astype(int)
    runs = [list(group) for _, group in groupby(range(len(rows)), key=lambda k: nodes[k])]
    return [(int(nodes[run[0]]), run[0], run[-1]) for run in runs]


def mark_grids(axes, position, rows, named=True):
    """Every other grid as a band; with `named` its nodes above the axes."""
    ends = np.concatenate([[position[0] - 0.5], 0.5 * (position[1:] + position[:-1]), [position[-1] + 0.5]])
    axes.set_xlim(ends[0], ends[-1])
    for k, (nodes, first, last) in enumerate(grids(rows)):
        left, right = ends[first], ends[last + 1]
        if k % 2 == 0:
            axes.axvspan(left, right, color="0.94", zorder=0, linewidth=0)
        if named:
            axes.text(
                0.5 * (left + right), 1.02, f"{nodes}", ha="center", transform=axes.get_xaxis_transform()
            )
    if named:
        axes.set_title("nodes along a side of each grid", pad=16)


def _draw_errors(axes, position, rows):
    axes.semilogy(position, column(rows, "residual"), "o-", color=COLOURS[0], label="residual (rms)")
    if "load_error" in rows[0]:
        load = np.abs(column(rows, "load_error"))
        axes.semilogy(position, load, "s-", color=COLOURS[1], label="|load error|")
    axes.set_ylabel("error, dimensionless")
    axes.legend()


def _draw_sets(axes, position, rows, sets):
    for name, colour, mark in zip(sets, (COLOURS[6], COLOURS[5], COLOURS[2]), "os^", strict=False):
        axes.plot(position, column(rows, name), f"{mark}-", color=colour, label=SETS[name])
    axes.set_yscale("symlog", linthresh=1.0)
    axes.set(ylabel="number of nodes")
    axes.set_ylim(bottom=0.0)
    axes.legend()
