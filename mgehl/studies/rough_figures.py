"""Pictures of study rough: load share and contact against lambda, and four states from fast to slow."""

import numpy as np
from matplotlib.colors import ListedColormap, LogNorm
from matplotlib.patches import Patch

from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.output.pictures.blocks import Blocks
from mgehl.output.pictures.style import COLOURS, STATUS_COLOURS, applied, legend_below, save, subplots

STARTS = {"film": {"marker": "o", "markerfacecolor": "none"}, "contact": {"marker": "x"}}
"""How the points of a start are drawn: both are seen where one covers the other."""

WITHOUT = {"film": 0.985, "contact": 0.96}
"""Height in a panel, from 0 to 1, at which points are marked that did not converge, by start."""

WINDOW = 1.25
"""How far from the centre, in semi-axes, maps of states show."""

MOST = 350
"""Blocks of nodes along a side of a small map."""


def load_share(path, points, fits):
    """Part of the load and of the Hertz area on contact against lambda.

    Of `points` that did not converge only the lambda is marked, on the upper edge. `fits` are functions of
    lambda by their names.
    """
    with applied():
        figure, (load, area) = subplots(1, 2, size=(10.5, 4.6))
        for (start, style), colour in zip(STARTS.items(), COLOURS, strict=False):
            own = [point for point in points if point.start == start]
            _draw_start(load, own, "contact_load_share", color=colour, label=f"from {start}", **style)
            _draw_start(area, own, "contact_area_over_hertz", color=colour, label=f"from {start}", **style)
        _draw_fits(load, points, fits)
        load.set(ylabel="part of the load on contact", ylim=(-0.03, 1.03))
        area.set(ylabel="contact area over Hertz area", ylim=(0.0, None))
        for axes in (load, area):
            axes.set(xscale="log", xlabel="lambda: film of smooth bodies over Sq")
            axes.legend(frameon=False)
        without = sum(not point.result.converged for point in points)
        note = f"; {without} of {len(points)} did not converge (ticks above)" if without else ""
        figure.suptitle(f"Rough ball on flat from full film to nearly dry{note}")
        save(figure, path)


def _draw_start(axes, points, number, **style):
    """A number of the `MixedResult` of the points that converged, and where the others are."""
    found = [point for point in points if point.result.converged]
    numbers = [getattr(point.result.mixed, number) for point in found]
    axes.plot([point.film_ratio for point in found], numbers, linestyle="none", **style)
    for point in points:
        if not point.result.converged:
            place = axes.get_xaxis_transform()
            axes.plot(point.film_ratio, WITHOUT[point.start], "|", color=style["color"], transform=place)


def _draw_fits(axes, points, fits):
    """Lines of the fits over the range of the points."""
    if not points:
        return
    ratio = np.geomspace(*(extreme(point.film_ratio for point in points) for extreme in (min, max)), 200)
    for (name, fit), style in zip(fits.items(), ("--", "-.", ":"), strict=False):
        axes.plot(ratio, [fit(each) for each in ratio], style, color="0.4", lw=1.0, label=name)


def states(path, points):
    """The status of the nodes above, the film below, at some speeds; all films on one scale."""
    with applied():
        figure, axes = subplots(2, len(points), size=(3.1 * len(points) + 1.0, 6.6), squeeze=False)
        norm = _norm(points)
        for point, (above, below) in zip(points, axes.T, strict=True):
            _status_map(above, point)
            image = _film_map(below, point, norm)
        figure.colorbar(image, ax=axes, label="film in the lower row, nm (orange: contact)", extend="both")
        for row in axes:
            row[0].set_ylabel("Y = y/b")
        for panel in axes[1]:
            panel.set_xlabel("X = x/a")
        kinds = {"film": LUBRICATED, "torn": CAVITATED, "contact": CONTACT}
        handles = [Patch(color=STATUS_COLOURS[kind], label=name) for name, kind in kinds.items()]
        legend_below(axes[1, 0], handles)
        save(figure, path)


def _norm(points):
    """A logarithmic scale of the films within the Hertz ellipses."""
    films = np.concatenate([point.film[_open(point)] for point in points])
    low, high = np.quantile(films, (0.01, 0.99)) if films.size else (1.0, 10.0)
    return LogNorm(low, max(high, 1.01 * low))


def _open(point):
    inside = point.mesh.X**2 + point.mesh.Y[:, None] ** 2 < 1.0
    return inside & (point.status != CONTACT) & (point.film > 0.0)


def _blocks(point):
    """Blocks of the nodes in the window, and which nodes these are."""
    mesh = point.mesh
    part = tuple(slice(*np.searchsorted(line, (-WINDOW, WINDOW))) for line in (mesh.Y, mesh.X))
    return Blocks(mesh.X[part[1]], mesh.Y[part[0]], MOST), part


def _status_map(axes, point):
    blocks, part = _blocks(point)
    colours = ListedColormap(STATUS_COLOURS)
    status = blocks.largest(point.status[part])
    axes.pcolormesh(blocks.X, blocks.Y, status, cmap=colours, vmin=-0.5, vmax=colours.N - 0.5,
                    shading="nearest", rasterized=True)  # fmt: skip
    mixed = point.result.mixed
    axes.set_title(
        f"{1e3 * point.speed:.4g} mm/s, lambda {point.film_ratio:.2g}\n"
        f"{100 * mixed.contact_load_share:.1f} % of the load on contact"
    )
    _finish(axes)


def _film_map(axes, point, norm):
    blocks, part = _blocks(point)
    contact = blocks.largest(point.status[part]) == CONTACT
    film = np.ma.masked_where(contact, np.maximum(blocks.least(point.film[part]), norm.vmin))
    axes.set_facecolor(STATUS_COLOURS[CONTACT])
    image = axes.pcolormesh(blocks.X, blocks.Y, film, norm=norm, shading="nearest", rasterized=True)
    _finish(axes)
    return image


def _finish(axes):
    """The Hertz circle, and equal scales."""
    turn = np.linspace(0.0, 2.0 * np.pi, 200)
    axes.plot(np.cos(turn), np.sin(turn), color="white", lw=0.8, ls="--")
    axes.set(aspect="equal")
