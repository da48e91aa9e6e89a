"""The picture of a loaded contact: centre lines of pressure and film, map of the status."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
import numpy as np  # noqa: E402
from matplotlib.colors import BoundaryNorm, ListedColormap  # noqa: E402
from matplotlib.patches import Patch  # noqa: E402

from mgehl.discretization.status import CONTACT, NAMES  # noqa: E402
from mgehl.model.hertz import hertz_pressure  # noqa: E402

# Colour-blind safe (Okabe and Ito).
PRESSURE, FILM, HERTZ = "#0072B2", "#D55E00", "0.6"
STATUS_COLOURS = ("0.85", "#56B4E9", "#F0E442", "#222222", "#D55E00")
OVERLAP = len(NAMES)
"""Drawn as a status: nodes outside of contact whose gap is negative."""
SMALLEST_FILM_RANGE = 10.0
"""Upper end of the film axis, in nm, where solid contact leaves no film to scale it by."""
STYLE = {"font.size": 9, "axes.titlesize": 9, "figure.dpi": 150}


def draw(path, solution):
    """Write the picture of a `Solution`'s whole-grid fields to `path`."""
    mesh, contact, fields = solution.mesh, solution.contact, solution.fields
    with plt.rc_context(STYLE):
        panels = 1 if mesh.is_line else 3
        figure, axes = plt.subplots(
            1, panels, figsize=(1.5 + 3.7 * panels, 4.2), layout="constrained", squeeze=False
        )
        i, j = mesh.nearest(0.0, 0.0)
        nm = 1e9 * contact.film_scale
        _centre_line(axes[0, 0], "X = x/a", mesh.X, fields.P[j], fields.H[j] * nm, contact)
        axes[0, 0].set_title("Y = 0, along the motion (left to right)")
        if not mesh.is_line:
            _centre_line(axes[0, 1], "Y = y/b", mesh.Y, fields.P[:, i], fields.H[:, i] * nm, contact)
            axes[0, 1].set_title("X = 0, across the motion")
            overlap = (fields.H < 0.0) & (fields.status != CONTACT)
            _status_map(axes[0, 2], mesh, np.where(overlap, OVERLAP, fields.status))
        figure.suptitle(_title(solution))
        figure.savefig(path)
        plt.close(figure)


def _title(solution):
    contact, mesh = solution.contact, solution.mesh
    load = f"{contact.load:.4g} N" + ("/m" if mesh.is_line else "")
    nodes = f"{mesh.nx} nodes" if mesh.is_line else f"{mesh.nx} x {mesh.ny} nodes"
    verdict = "converged" if solution.result.converged else "NOT converged"
    if solution.result.overlap.nodes:
        verdict += ", THE BODIES OVERLAP"
    return f"{1e3 * contact.speed:.4g} mm/s, {load}, {nodes}: {verdict}"


def _centre_line(axes, label, position, P, film, contact):
    p_h = 1e-9 * contact.hertz.p_h
    pressure = axes.plot(position, P * p_h, color=PRESSURE, label="pressure")
    dry = axes.plot(position, hertz_pressure(position, 0.0) * p_h, ":", color=HERTZ, label="Hertz")
    axes.set(xlabel=label, ylabel="pressure, GPa", ylim=(0.0, 1.25 * p_h), xlim=position[[0, -1]])
    films = axes.twinx()
    inside = np.abs(position) < 0.8
    top = max(3.0 * float(np.max(film[inside])), SMALLEST_FILM_RANGE)
    gap = films.plot(position, film, color=FILM, label="film")
    bottom = min(-0.05 * top, 1.1 * float(np.min(film)))
    films.set(ylabel="film thickness, nm", ylim=(bottom, top))
    lines = [*pressure, *dry, *gap]
    labels = [line.get_label() for line in lines]
    axes.legend(lines, labels, loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=3, frameon=False)


def _status_map(axes, mesh, status):
    colours = ListedColormap(STATUS_COLOURS)
    norm = BoundaryNorm(np.arange(colours.N + 1) - 0.5, colours.N)
    axes.pcolormesh(mesh.X, mesh.Y, status, cmap=colours, norm=norm, rasterized=True)
    axes.set(xlabel="X = x/a", ylabel="Y = y/b", title="status of the nodes", aspect="equal")
    handles = [Patch(color=STATUS_COLOURS[k], label=NAMES[k]) for k in (1, 2, 3)]
    if (status == OVERLAP).any():
        handles.append(Patch(color=STATUS_COLOURS[OVERLAP], label="overlap"))
    axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=4, frameon=False)
