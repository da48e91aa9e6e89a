"""Maps of a run in mm: film, pressure, status of the nodes; contact, and cavities by how full they are."""

from functools import partial

import matplotlib
import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse, Patch
from matplotlib.patheffects import withStroke
from matplotlib.ticker import LogLocator, MaxNLocator

from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED, NAMES, names
from mgehl.kinds.kind import pressure_unit
from mgehl.output.pictures import style
from mgehl.output.pictures.plane import INSIDE, MOST, OVERLAP, Plane, film_norm
from mgehl.output.pictures.titles import gap_words, map_labels, title, title_with_films

SIZE = 7.0, 6.0
"""Inches of a map with all that is around it."""
LONGEST, STRETCHED = 4.0, 2.0
"""Ratio of a map's sides up to which it is true to scale, and to which others are stretched."""
BAR, CAVITIES = 0.04, 0.27
"""Width of a colour bar over the map's longer side, and the height of that of cavities over the map's."""
ARROW = 0.4
"""Length in inches of the arrow that shows the motion."""
_EDGE = (withStroke(linewidth=3.0, foreground="white"),)


def film_map(solution):
    """Figure of film or gap in nm, on a scale of that inside the loaded zone; what is wider is grey."""
    return _map(draw_film, f"{gap_words(solution.contact)[0]}, {title_with_films(solution)}", solution)


def pressure_map(solution):
    """Figure of the pressure; of contact the outline."""
    factor, unit = pressure_unit(1e-9 * solution.pressure.max())
    return _smooth_map(factor * 1e-9 * solution.pressure, "pressure", unit, solution)


def shear_map(solution):
    """Figure of the shear stress by sliding in MPa; of contact the outline."""
    return _smooth_map(1e-6 * solution.fields.shear, "shear stress", "MPa", solution)


def flash_map(body, solution):
    """Figure of the flash temperature of body 1 or 2 in K above it, beside cavities, too; of contact the
    outline."""
    rise = getattr(solution.fields, f"flash_{body}")
    return _smooth_map(rise, f"flash temperature of body {body}", "K", solution, fluids=False)


def status_map(solution):
    """Figure of what each node is, on the whole grid."""
    return _map(draw_status, f"status of the nodes, {title(solution)}", solution)


def _smooth_map(values, name, unit, solution, fluids=True):
    """Figure of a field, (ny, nx), of the fluid's or else of a body's, which no cavity hides."""
    draw = partial(_draw_smooth, values, f"{name}, {unit}", fluids)
    return _map(draw, f"{name}, {title(solution)}", solution)


def _map(draw, said, solution):
    figure, axes = style.subplots(size=SIZE, layout=None)
    style.legend_below(axes, draw(axes, solution))
    axes.set_title(said, wrap=True)
    return figure


def draw_film(axes, solution, most=MOST):
    """The map of the film with its colour bars, at most `most` blocks along a side; return its handles."""
    plane = Plane(solution, most)
    norm, film = film_norm(plane), plane.film
    colours = matplotlib.colormaps[matplotlib.rcParams["image.cmap"]].with_extremes(over=style.HIDDEN)
    image = draw_image(axes, plane, np.maximum(film, norm.vmin), "bilinear", norm=norm, cmap=colours)
    thinner = ((film < norm.vmin) & (plane.status < CAVITATED)).any()
    extend = ("neither", "min", "max", "both")[thinner + 2 * (film > norm.vmax).any()]
    steps = MaxNLocator(6, steps=[1, 2, 5, 10])
    if isinstance(norm, LogNorm):
        steps = LogLocator(subs=(1.0, 2.0, 5.0))
    numbers = {"ticks": steps, "format": "%g", "extend": extend}
    bar = colour_bar(axes, plane, image, gap_words(solution.contact)[1], **numbers)
    bar.minorticks_off()
    if solution.contact.surface is None:  # of rough bodies there are too many to be read
        _label_lines(axes, plane, bar.get_ticks())
    return [*draw_cavities(axes, plane), *draw_sets(axes, plane), *finish(axes, solution, plane)]


def _draw_smooth(values, label, fluids, axes, solution):
    """As `draw_film`, of another field, (ny, nx)."""
    plane = Plane(solution)
    image = draw_image(axes, plane, plane.largest(values), "bilinear")
    if fluids:
        colour_bar(axes, plane, image, label)
    else:
        bar(axes, plane, image, (0.0, 1.0), label=label)
    handles = draw_cavities(axes, plane) if fluids else []
    if (plane.status == CONTACT).any():
        _contour(axes, plane, plane.status == CONTACT, (0.5,), colors=style.CONTACT_COLOUR, linewidths=1.2)
        handles.append(Patch(facecolor="none", edgecolor=style.CONTACT_COLOUR, label="contact"))
    return handles + finish(axes, solution, plane)


def draw_status(axes, solution):
    """What each node is."""
    plane = Plane(solution, whole=True)
    sets = draw_sets(axes, plane, BOUNDARY, names(solution.is_dry))
    return [*draw_cavities(axes, plane), *sets, *finish(axes, solution, plane)]


def draw_image(axes, plane, values, interpolation="nearest", **options):
    """Values of blocks as an image."""
    options |= {"origin": "lower", "extent": plane.blocks.extent, "aspect": "auto"}
    return axes.imshow(values, interpolation=interpolation, **options)


def colour_bar(axes, plane, image, label, **options):
    """A colour bar beside the map, above that of cavities where there are some."""
    low = CAVITIES + 0.1 if (plane.status == CAVITATED).any() else 0.0
    return bar(axes, plane, image, (low, 1.0), label=label, **options)


def draw_cavities(axes, plane):
    """Cavities by how full of oil they are, with their colour bar; their handles."""
    cavity = plane.status == CAVITATED
    if not cavity.any():
        return []
    filling = np.ma.masked_where(~cavity, plane.filling)
    image = draw_image(axes, plane, filling, cmap=style.FILLING_MAP, vmin=0.0, vmax=1.0)
    bar(axes, plane, image, (0.0, CAVITIES), label="cavity:\npart filled", ticks=(0.0, 0.5, 1.0))
    # The boundary's pressure is given: it is no end of the cavity.
    inner = np.ma.masked_where(plane.status == BOUNDARY, cavity)
    _contour(axes, plane, inner, (0.5,), colors="black", linestyles="--", linewidths=0.8)
    return [Line2D([], [], color="black", linestyle="--", linewidth=0.8, label="edge of a cavity")]


def draw_sets(axes, plane, least=CONTACT, known=NAMES):
    """Contact and what else is at least that, in the colours of their status; their handles."""
    shown = np.ma.masked_less(plane.status, least)
    draw_image(axes, plane, shown, cmap=style.STATUS_MAP, norm=style.STATUS_NORM)
    found = [k for k in (LUBRICATED, CONTACT, OVERLAP) if k >= least and (plane.status == k).any()]
    return [Patch(color=style.STATUS_COLOURS[k], label=(*known, "overlap")[k]) for k in found]


def finish(axes, solution, plane):
    """Limits, names of the axes, Hertz's ellipse and the motion; handles of the legend. A map whose sides
    differ by more than LONGEST is stretched, which its axis says."""
    (left, right, bottom, top), contact = plane.blocks.extent, solution.contact
    drawn, true = _ratios(plane)
    x, y = (
        label if times < 1.0 + 1e-9 else f"{label} (stretched {times:.2g} times)"
        for label, times in zip(map_labels(solution), (drawn / true, true / drawn), strict=True)
    )
    axes.set(xlim=(left, right), ylim=(bottom, top), xlabel=x, ylabel=y, facecolor=style.HIDDEN)
    axes.set_box_aspect(1.0 / drawn)
    if not contact.is_loaded:
        return []
    if any(solution.motion):
        corner = left + 0.18 * (right - left), bottom + 0.1 * (top - bottom)
        scale = {"angles": "xy", "scale_units": "inches", "scale": 1.0 / ARROW}
        look = {"units": "inches", "width": 0.03, "pivot": "middle", "path_effects": _EDGE, "zorder": 5}
        axes.quiver(*corner, *solution.motion, **scale, **look)
    ends = solution.at_the_end
    a, b = 1e3 * ends.x_scale, 1e3 * ends.y_scale
    line = {"color": "black", "linestyle": ":", "linewidth": 1.3}
    axes.add_patch(Ellipse((0.0, 0.0), 2.0 * a, 2.0 * b, fill=False, path_effects=_EDGE, **line))
    size = f"a = b = {a:.3g} mm" if f"{a:.3g}" == f"{b:.3g}" else f"a = {a:.3g} mm, b = {b:.3g} mm"
    coated = "" if contact.deformation is None else ", uncoated"
    return [Line2D([], [], label=f"Hertz{coated}: {size}", **line)]


def _ratios(plane):
    """Width over height that a map is drawn with, and the true one."""
    left, right, bottom, top = plane.blocks.extent
    true = (right - left) / (top - bottom)
    return true if 1.0 / LONGEST <= true <= LONGEST else STRETCHED ** np.sign(true - 1.0), true


def bar(axes, plane, image, ends, **options):
    """A colour bar beside the map between two ends of its height."""
    wide = BAR * max(1.0, 1.0 / _ratios(plane)[0])
    beside = axes.inset_axes((1.0 + wide, ends[0], wide, ends[1] - ends[0]))
    return axes.figure.colorbar(image, cax=beside, **options)


def _contour(axes, plane, values, levels, **options):
    """Lines of equal values of blocks; none where blocks are one line, or lie on one side of them."""
    if min(values.shape) > 1 and any(values.min() < level < values.max() for level in levels):
        return axes.contour(plane.blocks.X, plane.blocks.Y, values, levels, **options)


def _label_lines(axes, plane, levels):
    """Lines of equal film with their numbers, inside the loaded zone and off its rim and the contact."""
    shown = np.ma.masked_where((plane.distance > INSIDE[0]) | (plane.status > LUBRICATED), plane.film)
    levels = [level for level in levels if shown.min() < level < shown.max()]
    lines = _contour(axes, plane, shown, levels, colors="white", linewidths=0.7) if levels else None
    if lines:
        axes.clabel(lines, fmt="%g", fontsize="small")
