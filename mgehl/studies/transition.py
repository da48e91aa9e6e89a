"""From a full film to full contact and back  [Liu fig. 14, table 1], on one grid.

Both branches are followed at the same speeds: where they differ, both are solutions of the same
discrete equations.
"""

import matplotlib
import numpy as np

from mgehl.discretization.status import CONTACT
from mgehl.output.pictures.plane import Blocks
from mgehl.output.pictures.style import COLOURS, subplots
from mgehl.studies.branch import Branch
from mgehl.studies.columns import told
from mgehl.studies.study import PAPER, merged, papers_grid

FASTEST, SLOWEST, COUNT = 7.5e-3, 5e-6, 25
"""m/s: the range of [Liu sec. 4.3]."""

COARSE = 257
"""Up to this many nodes the range begins at `FASTEST_ON_COARSE`: at the paper's there is no film."""

FASTEST_ON_COARSE = 0.1

STEPS = {"max_steps": 30, "squeeze": 3.0}
"""Most Newton steps: a point that is found takes 10 to 20, one that is not is tried again from a nearer
one. From a film as from one speed to the next there is squeeze."""

PAPER_RADIUS = 19.05e-3
"""The radius that the paper's labels U belong to; its other numbers belong to 12.7 mm."""

PROFILES = 6
"""Speeds in Figure 14a and b, from the last full film to the first full contact."""

FULL = 0.95
"""Contact over Hertz area from which on contact is called full."""

INSIDE = 0.9
"""Part of the ellipse whose films must fit into a picture."""

SMALLEST_AXIS = 1.0
"""nm."""

GREYS = "0.3", "0.55", "0.75", "0.85"
"""Of formulas."""


def run(study):
    """Walk the branches; write the table `transition-NODES` and the pictures of Figure 14."""
    nodes = study.asked.nodes or (COARSE,)
    directions = ("down", "up") if study.asked.branch == "both" else (study.asked.branch,)
    study.expected = len(nodes) * len(directions) * COUNT
    for n in nodes:
        points = []
        for direction in directions:
            way = speeds(n) if direction == "down" else speeds(n)[::-1]
            points += Branch(study, case(n), direction, points).walk(way)
        study.write_table(f"transition-{n}", map(row, points))
        study.draw(f"transition-{n}-films", films_and_contact, points)
        study.draw(f"transition-{n}-figure-14", figure_14, points)


def speeds(nodes):
    """The speeds of a grid, fast to slow."""
    fastest = FASTEST_ON_COARSE if nodes <= COARSE else FASTEST
    return [float(f"{speed:.4g}") for speed in np.geomspace(fastest, SLOWEST, COUNT)]


def case(nodes):
    """The tables of the headline contact on a grid."""
    return merged(PAPER, {"grid": papers_grid(nodes), "solver": STEPS})


def row(point):
    """Text of one point: the columns of the paper's Table 1, and ours."""
    result, U = point.result, point.result.groups.U
    errors = zip(("e^p", "e^p lubr.", "e^p solid"), point.sweep, strict=True)
    return {
        "grid": str(point.solution.mesh.nx),
        "branch": point.branch,
        "from": point.origin,
        "speed mm/s": f"{1e3 * point.speed:.4g}",
        "U of the paper": f"{U * point.solution.contact.radius_x / PAPER_RADIUS:.3e}",
        "U": f"{U:.3e}",
        "iterations": str(result.work.steps),
        **{name: f"{error:.1e}" for name, error in errors},
        **told(
            result,
            "load error, settled, residual, central nm, minimum nm, contact/Hertz area, load on contact",
        ),
        "load on fluid": f"{1.0 - result.contact.load_fraction:.4f}",
        **told(result, "Eq. 2 broken"),
        "by at most p_h": f"{result.other_inequality.worst:.1e}",
        **told(result, "at the interface"),
        "there by at most p_h": f"{result.pressure_inequality.worst:.1e}",
        "not continued because": point.obstacle,
        "nodes that can be neither": str(len(result.contradictions)),
        **told(result, "inlet cells, grid verdict, convolutions:.0f, wall s"),
    }


def films_and_contact(points):
    """Films and contact ratio against speed, both branches, with the formulas."""
    figure, (films, ratio) = subplots(1, 2, size=(10.5, 4.6))
    for branch, colour, mark in zip(("down", "up"), COLOURS, ("v", "^"), strict=False):
        own = [point for point in points if point.branch == branch and point.result.settled]
        if not own:
            continue
        mm_s = [1e3 * point.speed for point in own]
        for name, line in (("central", "-"), ("minimum", ":")):
            film = [getattr(point.result, f"{name}_film_nm") for point in own]
            label = f"{name}, {branch}"
            films.plot(mm_s, np.maximum(film, 0.0), mark + line, color=colour, label=label)
        area = [point.result.contact.area_fraction for point in own]
        ratio.plot(mm_s, area, mark + "-", color=colour, label=branch)
    own = sorted((each for each in points if each.branch == points[0].branch), key=lambda each: each.speed)
    formulas = [point.solution.contact.formulas for point in own]
    for name, grey in zip(formulas[0], GREYS, strict=False):
        heights, label = [1e9 * formula[name] for formula in formulas], name.replace("_", " ")
        films.plot([1e3 * each.speed for each in own], heights, "--", color=grey, lw=0.9, label=label)
    films.set(xscale="log", xlabel="speed, mm/s", ylabel="film, nm (0: contact)")
    films.set_yscale("symlog", linthresh=1.0)
    films.set_ylim(bottom=-0.1)
    ratio.set(xscale="log", xlabel="speed, mm/s", ylabel="contact area over Hertz area")
    for axes in (films, ratio):
        axes.legend()
    directions = " and ".join(dict.fromkeys(point.branch for point in points))
    figure.suptitle(f"{_name(points)}: film and contact, speed going {directions}")
    return figure


def figure_14(points):
    """(a) film across, (b) pressure before the contact, (c) map of the film; of one branch."""
    branch = points[0].branch
    own = [point for point in points if point.branch == branch and point.result.settled]
    mesh, nm = own[0].solution.mesh, 1e9 * own[0].solution.contact.film_scale
    i, j = mesh.centre
    figure, (across, inlet, film) = subplots(1, 3, size=(14.0, 4.4))
    shown = _between_film_and_contact(own)
    for point, colour in zip(shown, COLOURS, strict=False):
        label = f"{1e3 * point.speed:.3g} mm/s"
        across.plot(mesh.Y, point.fields.H[:, i] * nm, color=colour, lw=1.0, label=label)
        inlet.plot(mesh.X, point.fields.P[j], color=colour, lw=1.0, label=label)
    top = max(_top(point, mesh, nm) for point in shown)
    across.set(xlim=(-1.2, 1.2), ylim=(-0.03 * top, top), xlabel="Y = y/b", ylabel="film, nm")
    across.set_title("a  film at X = 0")
    inlet.set(xlim=(-1.3, -0.7), ylim=(-0.02, 0.8), xlabel="X = x/a", ylabel="P = p/p$_h$")
    inlet.set_title("b  pressure at Y = 0 on the inlet side")
    inlet.legend()
    mixed = min(own, key=lambda point: abs(point.result.contact.area_fraction - 0.5))
    _film_map(figure, film, mesh, mixed, nm)
    figure.suptitle(f"{_name(points)}, {branch}")
    return figure


def _name(points):
    """Of a grid, in a title."""
    config = points[0].solution.config
    return f"{config.grid.nodes} nodes, {config.discretization.face_mobility} mean"


def _top(point, mesh, nm):
    """Where an axis of films should end, nm: a little above those inside the Hertz ellipse."""
    inside = mesh.X**2 + mesh.Y[:, None] ** 2 < INSIDE**2
    return max(SMALLEST_AXIS, 1.2 * nm * point.fields.H[inside].max())


def _film_map(figure, axes, mesh, point, nm):
    top, blocks = _top(point, mesh, nm), Blocks(mesh.X, mesh.Y)
    contact = blocks.largest(point.fields.status) == CONTACT
    H = np.ma.masked_where(contact, blocks.least(point.fields.H * nm))
    colours = matplotlib.colormaps[matplotlib.rcParams["image.cmap"]].with_extremes(bad="black")
    image = axes.pcolormesh(blocks.X, blocks.Y, H, cmap=colours, vmin=0.0, vmax=top, rasterized=True)
    figure.colorbar(image, ax=axes, label="film, nm (black: contact)", extend="max")
    axes.set(aspect="equal", xlim=(-1.2, 1.2), ylim=(-1.2, 1.2), xlabel="X = x/a", ylabel="Y = y/b")
    axes.set_title(f"c  film at {1e3 * point.speed:.3g} mm/s")


def _between_film_and_contact(points):
    """Some of a branch's points, from the last without contact to the first in full contact."""
    points = sorted(points, key=lambda point: -point.speed)
    area = [point.result.contact.area_fraction for point in points]
    first = next((k for k, part in enumerate(area) if part > 0.0), len(points))
    last = next((k for k, part in enumerate(area) if part > FULL), len(points) - 1)
    span = points[max(0, first - 1) : last + 1]
    chosen = np.unique(np.linspace(0, len(span) - 1, PROFILES).round().astype(int))
    return [span[k] for k in chosen]
