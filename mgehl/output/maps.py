"""Maps of a run: film, pressure and status of the nodes, contact and cavitation outlined."""

import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap, LogNorm, Normalize
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import LogLocator, MaxNLocator

from mgehl.discretization.status import CAVITATED, CONTACT, NAMES
from mgehl.output.blocks import MOST, Blocks
from mgehl.output.style import STATUS_COLOURS, subplots
from mgehl.output.titles import title

SIZE = (7.6, 6.4)
OVERLAP = len(NAMES)
"""Drawn as a status: nodes outside of contact whose gap is negative."""
WINDOW = 1.35
"""How far from the centre, in X and Y, the map of the film shows: the dry contact ends at 1."""
DECADES = 1e3
"""Largest ratio of films on one map: thinner ones are drawn as the thinnest."""
LINEAR_UP_TO = 8.0
"""Ratio of films from which the map's scale is logarithmic."""


def film_map(solution):
    """Figure of the film in nm about the dry contact, on a scale of the film inside it."""
    figure, axes = subplots(size=SIZE)
    mesh, fields = solution.mesh, solution.fields
    i, j = _near(mesh.X), _near(mesh.Y)
    blocks = Blocks(mesh.X[i], mesh.Y[j])
    film = blocks.least(1e9 * solution.contact.film_scale * fields.H[j, i])
    status = blocks.largest(drawn_status(fields)[j, i])
    norm = film_scale(blocks, film, status)
    shown = np.clip(film, norm.vmin, norm.vmax)
    image = axes.pcolormesh(blocks.X, blocks.Y, shown, norm=norm, shading="nearest", rasterized=True)
    figure.colorbar(image, ax=axes, label="film thickness, nm", extend=_beyond(film, norm))
    lines = axes.contour(blocks.X, blocks.Y, shown, _levels(norm), colors="white", linewidths=0.7)
    axes.clabel(lines, fmt="%.3g", fontsize="small")
    _finish(axes, blocks, status)
    axes.set(title="film thickness")
    figure.suptitle(title(solution))
    return figure


def pressure_map(solution):
    """Figure of the pressure in GPa."""
    figure, axes = subplots(size=SIZE)
    mesh, fields = solution.mesh, solution.fields
    blocks = Blocks(mesh.X, mesh.Y)
    pressure = blocks.largest(1e-9 * solution.contact.pressure_scale * fields.P)
    image = axes.pcolormesh(blocks.X, blocks.Y, pressure, shading="nearest", rasterized=True)
    figure.colorbar(image, ax=axes, label="pressure, GPa")
    _finish(axes, blocks, blocks.largest(drawn_status(fields)))
    axes.set(title="pressure")
    figure.suptitle(title(solution))
    return figure


def status_map(solution):
    """Figure of what each node is."""
    figure, axes = subplots(size=SIZE)
    draw_status(axes, solution)
    axes.set(title="status of the nodes")
    figure.suptitle(title(solution))
    return figure


def draw_status(axes, solution, most=MOST):
    """The map of the status with its legend, at most `most` blocks along a side."""
    blocks = Blocks(solution.mesh.X, solution.mesh.Y, most)
    status = blocks.largest(drawn_status(solution.fields))
    colours = ListedColormap(STATUS_COLOURS)
    norm = BoundaryNorm(np.arange(colours.N + 1) - 0.5, colours.N)
    axes.pcolormesh(blocks.X, blocks.Y, status, cmap=colours, norm=norm, shading="nearest", rasterized=True)
    axes.set(xlabel="X = x/a", ylabel="Y = y/b", aspect="equal")
    handles = [Patch(color=STATUS_COLOURS[k], label=NAMES[k]) for k in (1, 2, 3)]
    if (status == OVERLAP).any():
        handles.append(Patch(color=STATUS_COLOURS[OVERLAP], label="overlap"))
    _legend(axes, handles)


def drawn_status(fields):
    """The status of each node, with nodes whose gap is negative without contact as OVERLAP."""
    return np.where((fields.H < 0.0) & (fields.status != CONTACT), OVERLAP, fields.status)


def film_scale(blocks, film, status):
    """Norm of the film inside the dry contact; about it, where all of that is in contact.

    Logarithmic where the film spans more than LINEAR_UP_TO, and over DECADES at the most.
    """
    distance = np.hypot(blocks.X[None, :], blocks.Y[:, None])
    open_film = (status != CONTACT) & (film > 0.0)
    inside = open_film & (distance < 0.95)
    films = film[inside if inside.sum() > 0.02 * (distance < 0.95).sum() else open_film]
    low, high = float(films.min()), float(np.quantile(films, 0.98))
    if high <= LINEAR_UP_TO * low:
        return Normalize(low, high)
    return LogNorm(max(low, high / DECADES), high)


def _near(line):
    return slice(*np.searchsorted(line, (-WINDOW, WINDOW)))


def _beyond(film, norm):
    below, above = film.min() < norm.vmin, film.max() > norm.vmax
    return {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}[below, above]


def _levels(norm):
    """Round numbers for lines of equal film."""
    locator = LogLocator(subs=(1.0, 2.0, 5.0)) if isinstance(norm, LogNorm) else MaxNLocator(8)
    levels = locator.tick_values(norm.vmin, norm.vmax)
    return levels[(levels > norm.vmin) & (levels < norm.vmax)]


def _finish(axes, blocks, status):
    """Axes, outlines of contact and cavitation, legend."""
    handles = []
    contact, cavitated = status == CONTACT, status == CAVITATED
    if contact.any():
        axes.contourf(blocks.X, blocks.Y, contact, (0.5, 1.5), colors=[STATUS_COLOURS[CONTACT]])
        axes.contour(blocks.X, blocks.Y, contact, (0.5,), colors="white", linewidths=0.8)
        handles.append(Patch(facecolor=STATUS_COLOURS[CONTACT], edgecolor="white", label="contact"))
    if cavitated.any():
        axes.contour(blocks.X, blocks.Y, cavitated, (0.5,), colors="black", linestyles="--", linewidths=1.0)
        handles.append(Line2D([], [], color="black", linestyle="--", linewidth=1.0, label="cavitation"))
    axes.set(xlabel="X = x/a", ylabel="Y = y/b", aspect="equal")
    if handles:
        _legend(axes, handles)


def _legend(axes, handles):
    axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=4)
