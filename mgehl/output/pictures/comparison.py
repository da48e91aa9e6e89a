"""Several runs in one picture: centre lines of pressure and film, and how they converged."""

from itertools import cycle

import numpy as np
from matplotlib.ticker import MaxNLocator

from mgehl.errors import UserError
from mgehl.model.hertz import hertz_pressure
from mgehl.output.center_line import center_line
from mgehl.output.pictures import wedge_picture
from mgehl.output.pictures.film_scale import DECADES, LINEAR_UP_TO
from mgehl.output.pictures.history_picture import column, cycles, grids
from mgehl.output.pictures.lines import ALONG_X, ALONG_Y, across, along, film_range, film_words, names
from mgehl.output.pictures.style import COLOURS, GUIDE, HERTZ, legend_under_all, subplots
from mgehl.output.pictures.titles import common_labels, common_title

INSIDE, ROOM = 0.8, 2.0
"""Part of the dry contact whose films make a logarithmic axis, and its room below them."""
STROKES = ("-", "--", "-.", ":")
"""One for each round through the colours."""


def compare_lines(solutions, labels):
    """Figure of the centre lines of all runs, in the units of each run's own contact.

    Raises UserError where the contacts are not of one kind.
    """
    kinds = {each.config.contact.kind for each in solutions}
    if len(kinds) > 1:
        raise UserError("runs of different kinds of contact have no common picture: plot each")
    if not solutions[0].contact.is_loaded:
        return _compare_bearings(solutions, labels)
    is_line = solutions[0].mesh.is_line
    columns = 1 if is_line else 2
    figure, axes = subplots(2, columns, size=(1.2 + 4.9 * columns, 7.2), sharex="col", squeeze=False)
    _compare(axes[:, 0], solutions, labels, along)
    found = {names(solution.contact) for solution in solutions}
    name_along, name_across = found.pop() if len(found) == 1 else (ALONG_X, ALONG_Y)
    axes[0, 0].set_title(name_along)
    if not is_line:
        _compare(axes[:, 1], solutions, labels, across)
        axes[0, 1].set_title(name_across)
    for panel, name in zip(axes[1], common_labels(solutions), strict=False):
        panel.set_xlabel(name)
    return _finished(figure, axes[0, 0], "centre lines", solutions)


def compare_histories(solutions, labels):
    """Figure of residual and load error of all runs against their cycles; a ring where a grid begins."""
    loaded = all("load_error" in each.rows[0] for each in solutions if each.rows)
    panels = 2 if loaded else 1
    figure, axes = subplots(panels, 1, size=(8.4, 1.6 + 2.6 * panels), sharex=True, squeeze=False)
    units = []
    for solution, label, style in zip(solutions, labels, _styles(), strict=False):
        position, unit = cycles(solution.rows)
        units.append(unit)
        first = [begin for begin, _ in grids(solution.rows)]
        for panel, name in zip(axes[:, 0], ("residual", "load_error"), strict=False):
            values = np.abs(column(solution.rows, name))
            panel.plot(position, values, label=label, **style)
            panel.plot(position[first], values[first], "o", color=style["color"], markerfacecolor="white")
    for panel, name in zip(axes[:, 0], ("residual (rms)", "|load error|"), strict=False):
        panel.set(yscale="log", ylabel=f"{name}, dimensionless")
    axes[-1, 0].set_xlabel(" or ".join(dict.fromkeys(units)))
    axes[-1, 0].xaxis.set_major_locator(MaxNLocator(integer=True))
    axes[0, 0].set_title("a ring where a grid begins")
    return _finished(figure, axes[0, 0], "convergence", solutions)


def _compare(axes, solutions, labels, line):
    """Pressures above and films below, on one axis."""
    pressures, films = axes
    ranges, reach = [], []
    for solution, label, style in zip(solutions, labels, _styles(), strict=False):
        position, P, H = line(solution)
        GPa, nm = 1e-9 * solution.contact.pressure_scale, 1e9 * solution.contact.film_scale
        pressures.plot(position, P * GPa, label=label, **style)
        films.plot(position, H * nm, label=label, **style)
        ranges.append(film_range(position, H * nm))
        reach.append(position[[0, -1]])
    for GPa in dict.fromkeys(1e-9 * each.contact.pressure_scale for each in solutions):
        X = np.linspace(-1.0, 1.0, 201)
        pressures.plot(X, hertz_pressure(X, 0.0) * GPa, ":", color=HERTZ, linewidth=1, label="Hertz")
    low, high = np.transpose(ranges)
    units = dict.fromkeys(film_words(solution.contact)[1] for solution in solutions)
    films.set(ylabel=" or ".join(units), ylim=(low.min(), high.max()), xlim=_widest(reach))
    if logarithmic := _log_limits([line(solution)[::2] for solution in solutions], solutions):
        films.set(yscale="log", ylim=logarithmic)
    pressures.set(ylabel="pressure, GPa")
    pressures.set_ylim(bottom=0.0)


def _log_limits(lines, solutions):
    """Ends in nm of a logarithmic axis of the films; None where they differ too little for one.

    What counts are the films inside the dry contact, contact apart.
    """
    nm = [1e9 * each.contact.film_scale for each in solutions]
    inside = [H[np.abs(X) < INSIDE] * scale for (X, H), scale in zip(lines, nm, strict=True)]
    films = np.concatenate([film[film > 0.0] for film in inside])
    if not len(films):
        return None
    low, high = max(films.min(), films.max() / DECADES), films.max()
    return (low / ROOM, high * ROOM**2) if high > LINEAR_UP_TO * low else None


def _widest(reach):
    first, last = np.transpose(reach)
    return first.min(), last.max()


def _compare_bearings(solutions, labels):
    figure, axes = subplots(size=(7.4, 4.8))
    for solution, label, style in zip(solutions, labels, _styles(), strict=False):
        axes.plot(*center_line(solution.mesh, solution.fields), label=label, **style)
    axes.axhline(0.0, color=GUIDE, linewidth=0.8, zorder=0)
    edges = _widest([solution.mesh.edges for solution in solutions])
    axes.set(xlabel="X, mm", ylabel=wedge_picture.UNIT, xlim=edges, title="centre line")
    return _finished(figure, axes, "centre lines", solutions)


def _styles():
    """Colour and stroke of one run after the other."""
    for stroke in cycle(STROKES):
        for colour in COLOURS:
            yield {"color": colour, "linestyle": stroke}


def _finished(figure, axes, what, solutions):
    """The figure with its title and, below all panels, the legend of one of them."""
    named = {line.get_label(): line for line in axes.get_lines() if not line.get_label().startswith("_")}
    legend_under_all(figure, list(named.values()))
    figure.suptitle(f"{what}, {common_title(solutions)}")
    return figure
