"""Pictures of a wedge bearing: map of the pressure and its centre line."""

import numpy as np
from matplotlib.colors import Normalize

from mgehl.discretization.status import CONTACT
from mgehl.output.center_line import center_line
from mgehl.output.pictures import style
from mgehl.output.pictures.blocks import Blocks
from mgehl.output.pictures.titles import title

SIGNED, ROUNDING = "RdBu_r", 1e-9
"""Colours of pressures of both signs; part of the largest below which a negative one is none."""
UNIT = "P = m$^2$p/($\\eta$u), 1/mm"


def drawn(solution):
    """The picture that a run leaves, of a `Solution`, as the bytes of a PNG file: of one line no map."""
    with style.applied():
        if solution.mesh.is_line:
            return style.rendered(centre_line(solution), "png")
        figure, axes = style.subplots(1, 2, size=(10.5, 3.9))
        _draw_map(figure, axes[0], solution)
        _draw_line(axes[1], solution)
        figure.suptitle(title(solution))
        return style.rendered(figure, "png")


def centre_line(solution):
    """Figure of the pressure on Y = 0, as P and in MPa."""
    figure, axes = style.subplots(size=(6.8, 4.2))
    _draw_line(axes, solution)
    unit, _ = _unit(solution.contact)
    MPa = 1e-6 * solution.contact.pressure_scale / unit
    if MPa != 1.0:
        right = axes.secondary_yaxis("right", functions=(lambda P: P * MPa, lambda p: p / MPa))
        right.set_ylabel("pressure, MPa")
    figure.suptitle(title(solution))
    return figure


def pressure_picture(solution):
    """Figure of the map of the pressure over the pad."""
    figure, axes = style.subplots(size=(7.4, 4.6))
    _draw_map(figure, axes, solution)
    figure.suptitle(title(solution))
    return figure


def pressure_map(axes, mesh, fields, limits=None, unit=1.0):
    """Draw P times a `unit` over the pad, solid grey; return the image for a colour bar."""
    blocks = Blocks(mesh.X, mesh.Y)
    solid = blocks.largest(fields.status) == CONTACT
    P = np.ma.masked_where(solid, unit * blocks.largest(fields.P))
    norm, colours = pressure_scale(*(limits or (float(P.min()), float(P.max()))))
    image = axes.pcolormesh(
        blocks.X, blocks.Y, P, norm=norm, cmap=colours, shading="nearest", rasterized=True
    )
    axes.set_facecolor(style.SOLID)
    axes.set(xlabel="X, mm", ylabel="Y, mm", aspect="equal", title="pressure (solid grey)")
    return image


def pressure_scale(low, high):
    """Norm and colours of pressures: of both signs two colours about a white zero."""
    if low >= -ROUNDING * high:
        return Normalize(low, high), None
    largest = max(-low, high)
    return Normalize(-largest, largest), SIGNED


def _unit(bearing):
    """What P is multiplied by, and what the product is called: MPa of a pad that its films describe."""
    return (1e-6 * bearing.pressure_scale, "pressure, MPa") if bearing.level else (1.0, UNIT)


def _draw_map(figure, axes, solution):
    unit, name = _unit(solution.contact)
    image = pressure_map(axes, solution.mesh, solution.fields, unit=unit)
    figure.colorbar(image, ax=axes, label=name)


def _draw_line(axes, solution):
    mesh, (unit, name) = solution.mesh, _unit(solution.contact)
    X, P = center_line(mesh, solution.fields)
    axes.plot(X, unit * P, color=style.PRESSURE)
    axes.axhline(0.0, color=style.GUIDE, linewidth=0.8, zorder=0)
    axes.set(xlabel="X, mm", ylabel=name, title="centre line", xlim=mesh.edges)
