"""Several runs in one picture: centre lines of pressure and film, and how they converged."""

from itertools import cycle, product

import numpy as np
from matplotlib.ticker import MaxNLocator

from mgehl.errors import UserError
from mgehl.output.centre_line import centre_pressure
from mgehl.output.pictures import wedge_picture
from mgehl.output.pictures.history import column, cycles, grids
from mgehl.output.pictures.lines import lines_on
from mgehl.output.pictures.style import COLOURS, GUIDE, HERTZ, legend_under_all, subplots
from mgehl.output.pictures.titles import common_title

STROKES = "-", "--", "-.", ":"
"""One for each round through the colours."""


def compare_lines(solutions, labels):
    """Figure of the centre lines of all runs, in the units of each run's own contact. Raises UserError
    where the contacts are not of one kind."""
    if len({each.config.contact.kind for each in solutions}) > 1:
        raise UserError("runs of different kinds of contact have no common picture: plot each")
    if not solutions[0].contact.is_loaded:
        return _compare_bearings(solutions, labels)
    panels = 1 if solutions[0].mesh.is_line else 2
    figure, axes = subplots(2, panels, size=(1.2 + 4.9 * panels, 7.2), squeeze=False)
    for (above, below), own in zip(axes.T, lines_on(axes, solutions), strict=True):
        for line, label, style in zip(own, labels, _styles(), strict=False):
            above.plot(line.X, line.P, label=label, **style)
            below.plot(line.X, line.film, label=label, **style)
        for line in {line.hertz.max(): line for line in own}.values():
            above.plot(line.fine, line.hertz, ":", color=HERTZ, linewidth=1, label="Hertz")
    end = " at the end" if any(each.last for each in solutions) else ""
    return _finished(figure, axes[0, 0], f"centre lines{end}", solutions)


def compare_histories(solutions, labels):
    """Figure of residual and load error of all runs against their cycles; a ring where a grid begins."""
    errors = {"residual": "residual (rms), dimensionless", "load_error": "|load error|, dimensionless"}
    if not all("load_error" in each.rows[0] for each in solutions if each.rows):
        del errors["load_error"]
    figure, axes = subplots(len(errors), size=(8.4, 1.6 + 2.6 * len(errors)), sharex=True, squeeze=False)
    units = {}
    for solution, label, style in zip(solutions, labels, _styles(), strict=False):
        position, unit = cycles(solution.rows)
        units[unit] = True
        begins = [k for k, _ in grids(solution.rows)]
        ring = {"marker": "o", "markerfacecolor": "white", "markevery": begins}
        for panel, name in zip(axes[:, 0], errors, strict=True):
            sizes = np.abs(column(solution.rows, name))
            if np.any(sizes > 0.0):  # the load of a dry contact is met exactly
                panel.plot(position, sizes, label=label, **ring, **style)
            panel.set(yscale="log", ylabel=errors[name])
    axes[-1, 0].set_xlabel(" or ".join(units))
    axes[-1, 0].xaxis.set_major_locator(MaxNLocator(integer=True))
    axes[0, 0].set_title("a ring where a grid begins")
    return _finished(figure, axes[0, 0], "convergence", solutions)


def _compare_bearings(solutions, labels):
    figure, axes = subplots(size=(7.4, 4.8))
    for solution, label, style in zip(solutions, labels, _styles(), strict=False):
        axes.plot(*centre_pressure(solution.mesh, solution.fields), label=label, **style)
    axes.axhline(0.0, color=GUIDE, linewidth=0.8, zorder=0)
    axes.margins(x=0.0)
    axes.set(xlabel="X, mm", ylabel=wedge_picture.UNIT, title="centre line")
    return _finished(figure, axes, "centre lines", solutions)


def _styles():
    """Colour and stroke of one run after the other."""
    return cycle({"color": colour, "linestyle": stroke} for stroke, colour in product(STROKES, COLOURS))


def _finished(figure, axes, what, solutions):
    """The figure with its title and, below all panels, the legend of one of them."""
    legend_under_all(figure, axes.get_legend_handles_labels()[0])
    figure.suptitle(f"{what}, {common_title(solutions)}", wrap=True)
    return figure
