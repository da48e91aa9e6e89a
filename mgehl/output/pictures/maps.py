"""Maps of a run in mm: film, pressure and status of the nodes, contact and cavitation outlined."""

import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.patches import Patch
from scipy.ndimage import binary_dilation

from mgehl.discretization.status import BOUNDARY, CONTACT, names
from mgehl.output.pictures.blocks import MOST, Blocks
from mgehl.output.pictures.film_scale import film_scale, levels_of
from mgehl.output.pictures.plane import (
    OVERLAP,
    add_arrow,
    between,
    colour_bar,
    draw_hertz,
    draw_image,
    drawn_status,
    grey_beyond,
    outline,
    true_to_scale,
)
from mgehl.output.pictures.style import STATUS_COLOURS, inches, legend_under_all, subplots
from mgehl.output.pictures.titles import map_labels, title, title_with_films
from mgehl.output.pictures.zone import loaded_zone, millimetres, window

SIDE = 5.2
"""Inches of the longer side of a map, which is drawn true to scale."""
LETTER = 1.25
"""Width of a letter of a picture's title over that of others, with room."""


def film_map(solution):
    """Figure of the film in nm, on a scale of the film inside the loaded zone; thicker films are grey."""
    return _film_map(solution, "film thickness")


def gap_map(solution):
    """As `film_map`, of bodies without a film."""
    return _film_map(solution, "gap")


def _film_map(solution, what):
    said = f"{what}, {title_with_films(solution)}"
    figure, axes = _map(view(solution)[0], said)
    return _finished(figure, said, draw_film(axes, solution, what))


def view(solution, most=MOST):
    """Blocks of the nodes in mm that maps of film and pressure show, and the nodes' slices (y, x)."""
    i, j = window(solution, loaded_zone(solution))
    x, y = millimetres(solution)
    return Blocks(x[i], y[j], most), (j, i)


def draw_film(axes, solution, what="film thickness", most=MOST):
    """The map of the film with its colour bar, at most `most` blocks along a side; return its handles."""
    (blocks, nodes), zone = view(solution, most), loaded_zone(solution)
    film = blocks.least(1e9 * solution.contact.film_scale * solution.fields.H[nodes])
    status = blocks.largest(drawn_status(solution.fields)[nodes])
    norm = film_scale(zone.distance(blocks.X, blocks.Y), film, status)
    image = draw_image(axes, blocks, np.clip(film, norm.vmin, norm.vmax), norm)
    levels, thinner = levels_of(norm), (film < norm.vmin) & (status != CONTACT)
    bar = colour_bar(axes, image, f"{what}, nm", extend="min" if thinner.any() else "neither")
    bar.set_ticks(levels, labels=[f"{level:g}" for level in levels], minor=False)
    bar.minorticks_off()
    if solution.contact.surface is None:  # of rough bodies there are too many to be read
        _label_lines(axes, blocks, film, zone, status, levels)
    thicker = grey_beyond(axes, blocks, film, norm.vmax)
    handles = outline(axes, blocks, status, filled=True)
    _finish(axes, solution)
    return [*handles, draw_hertz(axes, solution.contact), *thicker]


def pressure_map(solution):
    """Figure of the pressure in GPa."""
    blocks, nodes = view(solution)
    pressure = blocks.largest(1e-9 * solution.contact.pressure_scale * solution.fields.P[nodes])
    said = f"pressure, {title(solution)}"
    figure, axes = _map(blocks, said)
    colour_bar(axes, draw_image(axes, blocks, pressure), "pressure, GPa")
    handles = outline(axes, blocks, blocks.largest(drawn_status(solution.fields)[nodes]), filled=False)
    _finish(axes, solution)
    return _finished(figure, said, [*handles, draw_hertz(axes, solution.contact)])


def status_map(solution):
    """Figure of what each node is, on the whole grid."""
    blocks, said = Blocks(*millimetres(solution)), f"status of the nodes, {title(solution)}"
    figure, axes = _map(blocks, said)
    status = blocks.largest(drawn_status(solution.fields))
    colours = ListedColormap(STATUS_COLOURS)
    norm = BoundaryNorm(np.arange(colours.N + 1) - 0.5, colours.N)
    axes.pcolormesh(blocks.X, blocks.Y, status, cmap=colours, norm=norm, shading="nearest", rasterized=True)
    true_to_scale(axes, blocks)
    found = [k for k in range(BOUNDARY + 1, OVERLAP + 1) if (status == k).any()]
    names_of = (*names(solution.is_dry), "overlap")
    _finish(axes, solution)
    return _finished(figure, said, [Patch(color=STATUS_COLOURS[k], label=names_of[k]) for k in found])


def _map(blocks, said):
    """A figure for a map of blocks, with room for a colour bar, a legend and the title `said`."""
    left, right, bottom, top = blocks.limits
    inch = SIDE / max(right - left, top - bottom)
    least = LETTER * inches(max(map(len, said.splitlines())))
    lines = 0.2 * len(said.splitlines())
    return subplots(size=(max(least, inch * (right - left) + 1.8), inch * (top - bottom) + 1.1 + lines))


def _finished(figure, said, handles):
    """With title and legend."""
    figure.suptitle(said)
    if handles:
        legend_under_all(figure, handles)
    return figure


def _label_lines(axes, blocks, film, zone, status, levels):
    """Lines of equal film with their numbers, inside the loaded zone and off the contact's edge."""
    if min(film.shape) < 2:  # no line can be drawn between nodes
        return
    X, Y, fine = between(blocks, film)
    *_, solid = between(blocks, binary_dilation(status == CONTACT))
    shown = np.where((zone.distance(X, Y) < 1.0) & (solid < 0.5), fine, np.nan)
    if np.isnan(shown).all():
        return
    levels = levels[(levels > np.nanmin(shown)) & (levels < np.nanmax(shown))]
    if len(levels):
        lines = axes.contour(X, Y, shown, levels, colors="white", linewidths=0.7)
        axes.clabel(lines, fmt="%g", fontsize="small")


def _finish(axes, solution):
    """Names of the axes with their units, and the motion."""
    x, y = map_labels(solution)
    axes.set(xlabel=x, ylabel=y)
    add_arrow(axes, solution.contact)
