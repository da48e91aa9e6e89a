"""Maps of a run: film, pressure and status of the nodes, contact and cavitation outlined."""

import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap, LogNorm, Normalize
from matplotlib.lines import Line2D
from matplotlib.patches import FancyArrowPatch, Patch
from matplotlib.patheffects import withStroke
from matplotlib.ticker import LogLocator, MaxNLocator

from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, NAMES, names
from mgehl.output.pictures.blocks import MOST, Blocks
from mgehl.output.pictures.lines import SMALLEST_FILM_RANGE
from mgehl.output.pictures.style import CONTACT_EDGE, STATUS_COLOURS, legend_below, subplots
from mgehl.output.pictures.titles import position_labels, title, title_with_films

SIDE = 5.2
"""Inches of the longer side of a map, which is drawn true to scale."""
OVERLAP = len(NAMES)
"""Drawn as a status: nodes outside of contact whose gap is negative."""
WINDOW = 1.35
"""How far from the centre, in X and Y, the map of the film shows: the dry contact ends at 1."""
DECADES = 1e3
"""Largest ratio of films on one map: thinner ones are drawn as the thinnest."""
LEAST_OPEN = 0.02
"""Part of the dry contact from which its film, where there is any, makes the scale."""
UNIFORM = 1.1
"""Ratio of films below which they are all one on the map."""
ARROW = 0.13
"""Length of the arrow that shows the motion, over the shorter side of the map."""
LINEAR_UP_TO = 8.0
"""Ratio of films from which the map's scale is logarithmic."""


def film_map(solution):
    """Figure of the film in nm about the dry contact, on a scale of the film inside it."""
    return _film_map(solution, "film thickness")


def gap_map(solution):
    """As `film_map`, of bodies without a film."""
    return _film_map(solution, "gap")


def _film_map(solution, what):
    mesh, fields = solution.mesh, solution.fields
    i, j = _near(mesh.X), _near(mesh.Y)
    blocks = Blocks(mesh.X[i], mesh.Y[j])
    film = blocks.least(1e9 * solution.contact.film_scale * fields.H[j, i])
    status = blocks.largest(drawn_status(fields)[j, i])
    norm = film_scale(blocks, film, status)
    figure, axes = _map(blocks)
    image = _draw(axes, blocks, np.maximum(film, norm.vmin), norm)
    levels = levels_of(norm)
    bar = figure.colorbar(image, ax=axes, label=f"{what}, nm", extend=_beyond(film, norm))
    bar.set_ticks(levels, labels=[f"{level:g}" for level in levels], minor=False)
    bar.minorticks_off()
    _label_lines(axes, blocks, np.where(_distance(blocks) < 1.0, film, np.nan), levels)
    _outline(axes, blocks, status, filled=True)
    _finish(figure, axes, solution, what, title_with_films)
    return figure


def pressure_map(solution):
    """Figure of the pressure in GPa."""
    mesh, fields = solution.mesh, solution.fields
    blocks = Blocks(mesh.X, mesh.Y)
    pressure = blocks.largest(1e-9 * solution.contact.pressure_scale * fields.P)
    figure, axes = _map(blocks)
    image = _draw(axes, blocks, pressure, None)
    figure.colorbar(image, ax=axes, label="pressure, GPa")
    _outline(axes, blocks, blocks.largest(drawn_status(fields)), filled=False)
    _finish(figure, axes, solution, "pressure")
    return figure


def status_map(solution):
    """Figure of what each node is."""
    mesh = solution.mesh
    figure, axes = _map(Blocks(mesh.X, mesh.Y))
    draw_status(axes, solution)
    figure.suptitle(f"status of the nodes, {title(solution)}")
    return figure


def draw_status(axes, solution, most=MOST):
    """The map of the status with its legend, at most `most` blocks along a side."""
    blocks = Blocks(solution.mesh.X, solution.mesh.Y, most)
    status = blocks.largest(drawn_status(solution.fields))
    colours = ListedColormap(STATUS_COLOURS)
    norm = BoundaryNorm(np.arange(colours.N + 1) - 0.5, colours.N)
    axes.pcolormesh(blocks.X, blocks.Y, status, cmap=colours, norm=norm, shading="nearest", rasterized=True)
    X, Y = position_labels(solution)
    axes.set(xlabel=X, ylabel=Y, aspect="equal")
    add_arrow(axes, solution.contact)
    found = [k for k in range(BOUNDARY + 1, OVERLAP + 1) if (status == k).any()]
    said = (*names(solution.is_dry), "overlap")
    handles = [Patch(color=STATUS_COLOURS[k], label=said[k]) for k in found]
    legend_below(axes, handles)


def add_arrow(axes, contact):
    """An arrow of the motion of loaded bodies in the lower left corner; the map's limits are set."""
    if not contact.is_loaded or contact.is_at_rest:
        return
    ends = arrow_ends(contact, axes.get_xlim(), axes.get_ylim())
    edge = [withStroke(linewidth=3.5, foreground="white")]
    axes.add_patch(FancyArrowPatch(
        *ends, arrowstyle="-|>", mutation_scale=11, shrinkA=0, shrinkB=0, color="black", linewidth=1.4,
        path_effects=edge, zorder=5,
    ))  # fmt: skip


def arrow_ends(contact, x_limits, y_limits):
    """Tail and head (X, Y) of the arrow on a map of these limits."""
    # The axes are in units of a and of b: a direction is stretched as they are.
    x, y = contact.motion[0] / contact.x_scale, contact.motion[1] / contact.y_scale
    length = ARROW * min(np.ptp(x_limits), np.ptp(y_limits))
    half = 0.5 * length * np.array((x, y)) / np.hypot(x, y)
    middle = np.array((x_limits[0], y_limits[0])) + 0.75 * length
    return middle - half, middle + half


def drawn_status(fields):
    """The status of each node, with nodes whose gap is negative without contact as OVERLAP."""
    return np.where((fields.H < 0.0) & (fields.status != CONTACT), OVERLAP, fields.status)


def film_scale(blocks, film, status):
    """Norm of the film inside the dry contact; about it, where all of that is in contact.

    Logarithmic where the film spans more than LINEAR_UP_TO, and over DECADES at the most.
    """
    inside, open_film = _distance(blocks) < 1.0, (status != CONTACT) & (film > 0.0)
    enough = (open_film & inside).sum() > LEAST_OPEN * inside.sum()
    films = film[open_film & inside if enough else open_film]
    if not len(films):
        return Normalize(0.0, SMALLEST_FILM_RANGE)
    low, high = float(films.min()), float(np.quantile(films, 0.95))
    if high < UNIFORM * low:
        return Normalize(low / UNIFORM, high * UNIFORM)
    if high <= LINEAR_UP_TO * low:
        return Normalize(low, high)
    return LogNorm(max(low, high / DECADES), high)


def _map(blocks):
    """A figure for a map of the blocks, with room for a colour bar and a legend."""
    width, height = np.ptp(blocks.X), np.ptp(blocks.Y)
    inch = SIDE / max(width, height)
    return subplots(size=(inch * width + 2.2, inch * height + 1.3))


def _near(line):
    return slice(*np.searchsorted(line, (-WINDOW, WINDOW)))


def _distance(blocks):
    return np.hypot(blocks.X[None, :], blocks.Y[:, None])


def _beyond(film, norm):
    below, above = film.min() < norm.vmin, film.max() > norm.vmax
    return {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}[below, above]


def levels_of(norm):
    """Round numbers for lines of equal film."""
    locator = LogLocator(subs=(1.0, 2.0, 5.0)) if isinstance(norm, LogNorm) else MaxNLocator(6)
    levels = np.asarray(locator.tick_values(norm.vmin, norm.vmax))
    return levels[(levels > norm.vmin) & (levels < norm.vmax)]


def _draw(axes, blocks, values, norm):
    axes.set_aspect("equal")
    return axes.pcolormesh(blocks.X, blocks.Y, values, norm=norm, shading="nearest", rasterized=True)


def _label_lines(axes, blocks, values, levels):
    """Lines of equal values with their numbers."""
    if min(values.shape) < 2 or np.isnan(values).all():  # no line can be drawn between nodes
        return
    levels = levels[(levels > np.nanmin(values)) & (levels < np.nanmax(values))]
    if len(levels):
        lines = axes.contour(blocks.X, blocks.Y, values, levels, colors="white", linewidths=0.7)
        axes.clabel(lines, fmt="%g", fontsize="small")


def _outline(axes, blocks, status, filled):
    """Contact and cavitation outlined, with their legend; contact black where it is `filled`."""
    handles = []
    contact, is_plane = status == CONTACT, min(status.shape) >= 2
    if contact.any() and is_plane:
        face = STATUS_COLOURS[CONTACT] if filled else "none"
        axes.contourf(blocks.X, blocks.Y, contact, (0.5, 1.5), colors=[face])
        axes.contour(blocks.X, blocks.Y, contact, (0.5,), colors=CONTACT_EDGE, linewidths=0.9)
        handles.append(Patch(facecolor=face, edgecolor=CONTACT_EDGE, label="contact"))
    # The boundary's pressure is given: it is no end of the cavity.
    cavitated = np.ma.masked_where(status == BOUNDARY, status == CAVITATED)
    if cavitated.any() and is_plane:
        # Black on white is seen on the darkest and on the brightest of the map's colours.
        axes.contour(blocks.X, blocks.Y, cavitated, (0.5,), colors="white", linewidths=2.2)
        axes.contour(blocks.X, blocks.Y, cavitated, (0.5,), colors="black", linestyles="--", linewidths=1)
        handles.append(Line2D([], [], color="black", linestyle="--", linewidth=1, label="cavitation"))
    if handles:
        legend_below(axes, handles)


def _finish(figure, axes, solution, what, titled=title):
    """Names of the axes with their units, the motion and what the picture is of, as `titled` says it."""
    X, Y = position_labels(solution)
    axes.set(xlabel=X, ylabel=Y)
    add_arrow(axes, solution.contact)
    figure.suptitle(f"{what}, {titled(solution)}")
