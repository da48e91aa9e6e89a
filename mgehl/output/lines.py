"""Centre lines of pressure and film of one run, against the dry contact."""

import numpy as np

from mgehl.model.hertz import hertz_pressure
from mgehl.output.style import FILM, HERTZ, PRESSURE, subplots
from mgehl.output.titles import title

SMALLEST_FILM_RANGE = 10.0
"""Upper end of the film axis, in nm, where solid contact leaves no film to scale it by."""


def centre_lines(solution):
    """Figure of pressure (GPa) and film (nm) along the motion and, of a point contact, across it."""
    panels = 1 if solution.mesh.is_line else 2
    figure, axes = subplots(1, panels, size=(1.2 + 4.9 * panels, 4.6), squeeze=False)
    draw_along(axes[0, 0], solution)
    if panels > 1:
        draw_across(axes[0, 1], solution)
    for panel, name, scale in zip(axes[0], "xy", _scales(solution), strict=False):
        add_millimetres(panel, name, scale)
    figure.suptitle(title(solution))
    return figure


def draw_along(axes, solution):
    """The lines along the motion, on Y = 0."""
    mesh, fields = solution.mesh, solution.fields
    _, j = mesh.nearest(0.0, 0.0)
    _draw(axes, mesh.X, fields.P[j], fields.H[j], solution.contact)
    axes.set(xlabel="X = x/a", title="Y = 0, along the motion (left to right)")


def draw_across(axes, solution):
    """The lines across the motion, on X = 0."""
    mesh, fields = solution.mesh, solution.fields
    i, _ = mesh.nearest(0.0, 0.0)
    _draw(axes, mesh.Y, fields.P[:, i], fields.H[:, i], solution.contact)
    axes.set(xlabel="Y = y/b", title="X = 0, across the motion")


def film_range(position, film):
    """Lower and upper end of a film axis: readable inside the dry contact, in the film's unit."""
    inside = np.abs(position) < 0.8
    top = max(3.0 * float(np.max(film[inside])), SMALLEST_FILM_RANGE)
    return min(-0.05 * top, 1.1 * float(np.min(film))), top


def add_millimetres(axes, name, scale):
    """The position in mm along the upper side; `scale` is metres per unit of X or Y."""
    mm = 1e3 * scale
    upper = axes.secondary_xaxis("top", functions=(lambda X: X * mm, lambda x: x / mm))
    upper.set_xlabel(f"{name}, mm")


def _scales(solution):
    return solution.contact.x_scale, solution.contact.y_scale


def _draw(axes, position, P, H, contact):
    p_h, film = 1e-9 * contact.pressure_scale, 1e9 * contact.film_scale * H
    pressure = axes.plot(position, P * p_h, color=PRESSURE, label="pressure")
    dry = axes.plot(position, hertz_pressure(position, 0.0) * p_h, ":", color=HERTZ, label="Hertz")
    axes.set(ylabel="pressure, GPa", ylim=(0.0, 1.25 * p_h), xlim=position[[0, -1]])
    films = axes.twinx()
    gap = films.plot(position, film, color=FILM, label="film")
    films.set(ylabel="film thickness, nm", ylim=film_range(position, film))
    lines = [*pressure, *dry, *gap]
    labels = [line.get_label() for line in lines]
    axes.legend(lines, labels, loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=3)
