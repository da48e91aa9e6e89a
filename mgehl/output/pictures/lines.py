"""Centre lines of pressure and film of one run, against the dry contact."""

from typing import NamedTuple

import numpy as np

from mgehl.discretization.status import CAVITATED, CONTACT
from mgehl.kinds.kind import pressure_unit
from mgehl.model.hertz import hertz_pressure
from mgehl.output.pictures import style
from mgehl.output.pictures.plane import DECADES, LINEAR
from mgehl.output.pictures.titles import common_labels, gap_words, title_with_films

INSIDE = {0.8: 3.0, 1.25: 1.0}
"""Parts of the dry contact whose films make the axis of films, the second where the first is all contact;
and its upper end over the largest of them, of a logarithmic axis the square."""
OF_LAYERS = 3.0
"""The same end where there is contact on layers alone."""
SHOWN, PRESSED = 2.0, 0.01
"""Semi-axes from the centre that are shown at the least, and part of the largest pressure that is."""
FINE = 801
"""Places at which the dry contact is drawn: nodes may be few."""
BARE = 1e-6
"""Part of the largest pressure by which the fluid's own must differ to be drawn."""
ALONG = {1.0: "left to right", -1.0: "right to left"}
"""The motion by its part along x, where it has no other."""
ANYWHERE = "Y = 0, along x", "X = 0, along y"
"""Where the motion is not along x, or there is none."""


class CentreLine(NamedTuple):
    """A centre line: place in semi-axes; total pressure and the fluid's own; gap and its oil in nm;
    status. Of the dry contact places of its own, pressure and gap."""

    X: np.ndarray
    P: np.ndarray
    p: np.ndarray
    film: np.ndarray
    oil: np.ndarray
    status: np.ndarray
    fine: np.ndarray
    hertz: np.ndarray
    dry: np.ndarray


def line_of(solution, across, GPa=1.0):
    """The `CentreLine` of a loaded contact along x, or along y where it is `across`; a GPa counts as so
    many."""
    mesh, fields, contact = solution.mesh, solution.fields, solution.contact
    i, j = mesh.centre
    part, X = ((slice(None), i), mesh.Y) if across else ((j, slice(None)), mesh.X)
    Pa, nm = 1e-9 * GPa, 1e9 * contact.film_scale
    unit = Pa * contact.pressure_scale
    layers = 1e9 * solution.config.contact.boundary_film
    P, film = unit * fields.P[part], nm * fields.H[part]
    fine, hertz = np.linspace(X[0], X[-1], FINE), contact.hertz_under(solution.load_share)
    ends, near = hertz.contact, fine / hertz.reach
    dry = ends.dry_gap(0.0 * near, near) if across else ends.dry_gap(near, 0.0 * near)
    return CentreLine(
        X, P, unit * fields.fluid_pressure[part], film,
        layers + fields.full_part[part] * (film - layers), fields.status[part],
        fine, Pa * ends.pressure_scale * hertz_pressure(near, 0.0), 1e9 * ends.film_scale * dry,
    )  # fmt: skip


def centre_lines(solution):
    """Figure of pressure above film, along x and, of a point contact, along y."""
    contact, panels = solution.contact, 1 if solution.mesh.is_line else 2
    figure, axes = style.subplots(2, panels, size=(1.2 + 4.9 * panels, 6.0), squeeze=False)
    style.legend_under_all(figure, draw_lines(axes, solution))
    for panel, name, scale in zip(axes[0], "xy", (contact.x_scale, contact.y_scale), strict=False):
        mm = 1e3 * scale
        upper = panel.secondary_xaxis("top", functions=(lambda X, mm=mm: X * mm, lambda x, mm=mm: x / mm))
        upper.set_xlabel(f"{name}, mm")
    figure.suptitle(f"centre lines, {title_with_films(solution)}")
    return figure


def draw_lines(axes, solution):
    """Pressures on the first row of axes, films on the second, along x and along y; their handles."""
    handles = []
    for (pressures, films), (line,) in zip(axes.T, lines_on(axes, [solution]), strict=True):
        handles += _draw(pressures, films, line, solution)
    return handles


def lines_on(axes, solutions):
    """The `CentreLine`s of runs for each column of axes, which get their limits and words."""
    factor, unit = pressure_unit(1e-9 * max(each.pressure.max() for each in solutions))
    lines = [[line_of(each, across, factor) for each in solutions] for across in range(axes.shape[1])]
    _limit(axes, lines)
    called = {_names(each) for each in solutions}
    titles = called.pop() if len(called) == 1 else ANYWHERE
    for (above, below), title, label in zip(axes.T, titles, common_labels(solutions), strict=False):
        above.set_title(title)
        below.set_xlabel(label)
    axes[0, 0].set_ylabel(f"pressure, {unit}")
    axes[1, 0].set_ylabel(" or ".join(dict.fromkeys(gap_words(each.contact)[1] for each in solutions)))
    return lines


def _names(solution):
    """What the two lines are called, by the direction of the motion, if there is one."""
    way = ALONG.get(solution.motion[0])
    return (f"Y = 0, along the motion ({way})", "X = 0, across the motion") if way else ANYWHERE


def _limit(axes, lines):
    """Limits for some `CentreLine`s, of each column of axes: what is loaded is shown, and films inside the
    dry contact can be read, on a logarithmic axis where they differ much. It begins below 0 only where
    bodies overlap."""
    columns, lines = lines, [line for column in lines for line in column]
    for inside in INSIDE:
        films = [line.film[(np.abs(line.X) < inside) & (line.status != CONTACT)] for line in lines]
        films, room = np.concatenate(films), INSIDE[inside]
        if (films > 0.0).any():
            break
    else:  # a layered contact may be wider
        films, room = np.concatenate([line.film[line.status == CONTACT] for line in lines]), OF_LAYERS
    thinnest, top = min(line.film.min() for line in lines), films.max(initial=1e-3)
    low = max(films[films > 0.0].min(initial=top), top / DECADES)
    for (pressures, below), column in zip(axes.T, columns, strict=True):
        lowest = 1.1 * min(line.P.min() for line in lines)  # below 0 under an ambient pressure
        pressures.set_ylim(lowest, 1.1 * max(line.P.max() for line in lines))
        pressures.sharex(below)
        pressures.tick_params(labelbottom=False)
        below.set_xlim(*_loaded(column))
        if top > LINEAR * low and thinnest > -low:
            below.set(yscale="log", ylim=(low / 2.0, room**2 * top))
            below.yaxis.set_major_formatter("{x:g}")
        else:
            below.set_ylim(min(0.0, 1.1 * thinnest), room * top)


def _loaded(lines):
    """Ends of what carries load, in semi-axes, with room about it, as far as there are nodes."""
    pressed = np.concatenate([line.X[line.P > PRESSED * line.P.max()] for line in lines])
    low, high = SHOWN * min(pressed.min(initial=-1.0), -1.0), SHOWN * max(pressed.max(initial=1.0), 1.0)
    return max(low, min(line.X[0] for line in lines)), min(high, max(line.X[-1] for line in lines))


def _draw(pressures, films, line, solution):
    """One line and its dry contact; the handles."""
    contact = solution.contact
    dry = f"dry contact (Hertz{'' if contact.deformation is None else ', uncoated'})"
    dotted = {"color": style.HERTZ, "linewidth": 1, "linestyle": ":", "label": dry}
    handles = pressures.plot(line.X, line.P, color=style.PRESSURE, label="pressure")
    solid, cavity = line.status == CONTACT, line.status == CAVITATED
    if (line.P - line.p)[solid].max(initial=0.0) > BARE * line.P.max():
        own = {"color": style.FLUID, "zorder": 1.9, "label": "pressure of the fluid in contact"}
        carried = {
            "color": style.CONTACT_COLOUR,
            "alpha": 0.4,
            "linewidth": 0,
            "label": "carried by solids",
        }
        handles += pressures.plot(line.X, line.p, **own)
        handles.append(pressures.fill_between(line.X, line.p, line.P, **carried))
    handles += films.plot(line.X, line.film, color=style.FILM, label=gap_words(contact)[0])
    for where, values, colour, label in (
        (solid, line.film, style.CONTACT_COLOUR, "contact"),
        (cavity, line.oil, style.CAVITY_COLOUR, "oil in a cavity"),
    ):
        if where.any():
            seen = np.maximum(values[where], films.get_ylim()[0])
            handles += films.plot(
                line.X[where], seen, ".", color=colour, label=label, clip_on=where is cavity
            )
    pressures.plot(line.fine, line.hertz, **dotted)
    return handles + films.plot(line.fine, line.dry, **dotted)
