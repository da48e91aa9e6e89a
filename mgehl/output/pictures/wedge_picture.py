"""Pictures of a wedge bearing: map of the pressure and its centre line."""

import numpy as np
from matplotlib.colors import Normalize

from mgehl.discretization.status import CONTACT
from mgehl.output.centre_line import centre_pressure
from mgehl.output.pictures import style
from mgehl.output.pictures.maps import colour_bar, draw_cavities, draw_image, finish
from mgehl.output.pictures.plane import Plane
from mgehl.output.pictures.titles import title

SIGNED, ROUNDING = "RdBu_r", 1e-9
"""Colours of pressures of both signs; part of the largest below which a negative one is none."""
UNIT = "P = m$^2$p/($\\eta$u), 1/mm"


def picture(solution):
    """Figure that a run leaves: map and centre line; of a single line no map."""
    if solution.mesh.is_line:
        return centre_line(solution)
    figure, axes = style.subplots(1, 2, size=(10.5, 3.9))
    pressure_map(axes[0], solution)
    _draw_line(axes[1], solution)
    figure.suptitle(title(solution))
    return figure


def centre_line(solution):
    """Figure of the pressure on Y = 0, as P and in MPa."""
    figure, axes = style.subplots(size=(6.8, 4.2))
    _draw_line(axes, solution)
    unit, _ = _unit(solution.contact)
    MPa = 1e-6 * solution.contact.pressure_scale / unit
    if MPa != 1.0:
        right = axes.secondary_yaxis("right", functions=(lambda P: P * MPa, lambda p: p / MPa))
        right.set_ylabel("pressure, MPa")
    axes.set_title(title(solution))
    return figure


def pressure_picture(solution):
    """Figure of the map of the pressure over the pad."""
    figure, axes = style.subplots(size=(7.4, 4.6))
    pressure_map(axes, solution)
    figure.suptitle(title(solution))
    return figure


def pressure_map(axes, solution, limits=None, **options):
    """Draw P over the pad with its colour bar, solid grey; `limits` are the ends of the scale."""
    plane, (unit, name) = Plane(solution, whole=True), _unit(solution.contact)
    P = np.ma.masked_where(plane.status == CONTACT, unit * plane.blocks.largest(solution.fields.P))
    norm, colours = pressure_scale(*(limits or (float(P.min()), float(P.max()))))
    image = draw_image(axes, plane, P, norm=norm, cmap=colours)
    colour_bar(axes, plane, image, name, **options)
    draw_cavities(axes, plane)
    finish(axes, solution, plane)
    axes.set(facecolor=style.SOLID, title="pressure (solid grey)")


def pressure_scale(low, high):
    """Norm and colours of pressures: of both signs two colours about a white zero."""
    if low >= -ROUNDING * high:
        return Normalize(low, high), None
    largest = max(-low, high)
    return Normalize(-largest, largest), SIGNED


def _unit(bearing):
    """What P is multiplied by, and what the product is called: MPa of a pad that its films describe."""
    return (1e-6 * bearing.pressure_scale, "pressure, MPa") if bearing.level else (1.0, UNIT)


def _draw_line(axes, solution):
    mesh, (unit, name) = solution.mesh, _unit(solution.contact)
    X, P = centre_pressure(mesh, solution.fields)
    axes.plot(X, unit * P, color=style.PRESSURE)
    axes.axhline(0.0, color=style.GUIDE, linewidth=0.8, zorder=0)
    axes.set(xlabel="X, mm", ylabel=name, title="centre line", xlim=mesh.edges)
