"""Centre lines of pressure and film of one run, against the dry contact."""

import numpy as np

from mgehl.model.hertz import hertz_pressure
from mgehl.output.pictures.style import FILM, HERTZ, PRESSURE, legend_below, subplots
from mgehl.output.pictures.titles import position_labels, title_with_films

ALONG, ACROSS = "Y = 0, along the motion (left to right)", "X = 0, across the motion"
ALONG_X, ALONG_Y = "Y = 0, along x", "X = 0, along y"
"""Where the motion is not along x."""
SMALLEST_FILM_RANGE = 10.0
"""Upper end of the film axis, in nm, where solid contact leaves no film to scale it by."""


def centre_lines(solution):
    """Figure of pressure (GPa) and film (nm) along x and, of a point contact, along y."""
    panels = 1 if solution.mesh.is_line else 2
    figure, axes = subplots(1, panels, size=(1.2 + 4.9 * panels, 4.6), squeeze=False)
    draw_along(axes[0, 0], solution)
    if panels > 1:
        draw_across(axes[0, 1], solution)
    contact = solution.contact
    for panel, name, scale in zip(axes[0], "xy", (contact.x_scale, contact.y_scale), strict=False):
        add_millimetres(panel, name, scale)
    figure.suptitle(f"centre lines, {title_with_films(solution)}")
    return figure


def along(solution):
    """X, P and H along x on Y = 0, (nx,) each."""
    mesh, fields = solution.mesh, solution.fields
    _, j = mesh.nearest(0.0, 0.0)
    return mesh.X, fields.P[j], fields.H[j]


def across(solution):
    """Y, P and H along y on X = 0, (ny,) each."""
    mesh, fields = solution.mesh, solution.fields
    i, _ = mesh.nearest(0.0, 0.0)
    return mesh.Y, fields.P[:, i], fields.H[:, i]


def names(contact):
    """What the two lines are called, by the direction of the motion, if there is one."""
    along_x = contact.motion == (1.0, 0.0) and not contact.is_at_rest
    return (ALONG, ACROSS) if along_x else (ALONG_X, ALONG_Y)


def film_words(contact):
    """What is between the bodies: its name, and what an axis shows."""
    return ("gap", "gap, nm") if contact.is_at_rest else ("film", "film thickness, nm")


def dry_words(contact):
    """What the gap of the dry contact is called: of a coated body it is not the coated one's."""
    return f"dry contact (Hertz{'' if contact.deformation is None else ', uncoated'})"


def draw_along(axes, solution):
    """The lines along x."""
    X, P, H = along(solution)
    _draw(axes, solution.contact, X, P, H, solution.contact.dry_gap(X, 0.0 * X))
    axes.set(xlabel=position_labels(solution)[0], title=names(solution.contact)[0])


def draw_across(axes, solution):
    """The lines along y."""
    Y, P, H = across(solution)
    _draw(axes, solution.contact, Y, P, H, solution.contact.dry_gap(0.0 * Y, Y))
    axes.set(xlabel=position_labels(solution)[1], title=names(solution.contact)[1])


def film_range(position, film):
    """Lower and upper end of a film axis: readable inside the dry contact, in the film's unit.

    It begins below 0 only where bodies overlap.
    """
    inside = np.abs(position) < 0.8
    top = max(3.0 * float(np.max(film[inside], initial=0.0)), SMALLEST_FILM_RANGE)
    return min(0.0, 1.1 * float(np.min(film))), top


def add_millimetres(axes, name, scale):
    """The position in mm along the upper side; `scale` is metres per unit of X or Y."""
    mm = 1e3 * scale
    upper = axes.secondary_xaxis("top", functions=(lambda X: X * mm, lambda x: x / mm))
    upper.set_xlabel(f"{name}, mm")


def _draw(axes, contact, position, P, H, dry_gap):
    GPa, nm = 1e-9 * contact.pressure_scale, 1e9 * contact.film_scale
    pressure = axes.plot(position, P * GPa, color=PRESSURE, label="pressure")
    axes.plot(position, hertz_pressure(position, 0.0) * GPa, ":", color=HERTZ, linewidth=1)
    axes.set(ylim=(0.0, 1.25 * max(GPa, GPa * float(np.max(P)))), xlim=position[[0, -1]])
    axes.set_ylabel("pressure, GPa", color=PRESSURE)
    films, (name, unit) = axes.twinx(), film_words(contact)
    film = films.plot(position, H * nm, color=FILM, label=name)
    dry = films.plot(position, dry_gap * nm, ":", color=HERTZ, linewidth=1, label=dry_words(contact))
    films.set(ylim=film_range(position, H * nm))
    films.set_ylabel(unit, color=FILM)
    legend_below(axes, [*pressure, *film, *dry])
