"""The picture of a rough or wavy surface: heights with the contact on them, gap, distribution."""

import numpy as np
from matplotlib.patches import Patch

from mgehl.discretization.status import CONTACT
from mgehl.output.pictures.blocks import Blocks
from mgehl.output.pictures.maps import WINDOW, add_arrow, drawn_status, film_scale, levels_of
from mgehl.output.pictures.style import CONTACT_EDGE, FILM, HERTZ, STATUS_COLOURS, legend_below, subplots
from mgehl.output.pictures.titles import position_labels, title
from mgehl.output.surface import surface_words
from mgehl.output.words import mixed_note

BARS = "0.7"
BINS = 61
"""Of the histogram."""
EDGES = 0.5, 99.5
"""Per cent of the heights that the map's scale begins and ends at."""
MOST = 350
"""Blocks of nodes along a side of each of the small maps, about as many as it has dots."""


def surface_picture(solution):
    """Figure of a solution whose contact has a surface; of a line contact its heights along x."""
    heights = heights_of(solution)
    panels = 2 if solution.mesh.is_line else 3
    figure, axes = subplots(1, panels, size=(1.0 + 4.4 * panels, 4.4))
    if solution.mesh.is_line:
        _profile(axes[0], solution, heights[0])
    else:
        _height_map(figure, axes[0], solution, heights)
        _gap_map(figure, axes[1], solution)
    _distribution(axes[-1], solution, heights)
    resolution = solution.result.resolution
    shown = surface_words(resolution.surface, resolution.surface_nodes)
    notes = shown, mixed_note(solution.result.mixed)
    figure.suptitle("\n".join(filter(None, (f"surface, {title(solution)}", *notes))))
    return figure


def heights_of(solution):
    """Heights of the nodes in m, a peak positive, (ny, nx)."""
    shape = solution.mesh.ny, solution.mesh.nx
    heights = solution.contact.surface.height(solution.x[None, :], solution.y[:, None])
    return np.broadcast_to(heights, shape)


def _window(mesh):
    """The nodes about the dry contact, along x and along y."""
    return [slice(*np.searchsorted(line, (-WINDOW, WINDOW))) for line in (mesh.X, mesh.Y)]


def _height_map(figure, axes, solution, heights):
    mesh, (i, j) = solution.mesh, _window(solution.mesh)
    blocks = Blocks(mesh.X[i], mesh.Y[j], MOST)
    nm = blocks.largest(1e9 * heights[j, i])
    low, high = np.percentile(nm, EDGES)
    image = axes.pcolormesh(
        blocks.X, blocks.Y, nm, cmap="gray", vmin=low, vmax=high, shading="nearest", rasterized=True
    )
    figure.colorbar(image, ax=axes, label="height, nm (a peak is positive)", extend="both")
    contact = blocks.largest(drawn_status(solution.fields)[j, i]) == CONTACT
    if contact.any():
        axes.contourf(blocks.X, blocks.Y, contact, (0.5, 1.5), colors=[CONTACT_EDGE])
        legend_below(axes, [Patch(color=CONTACT_EDGE, label="contact")])
    _finish(axes, solution, "heights")


def _gap_map(figure, axes, solution):
    mesh, (i, j) = solution.mesh, _window(solution.mesh)
    blocks = Blocks(mesh.X[i], mesh.Y[j], MOST)
    film = blocks.least(1e9 * solution.contact.film_scale * solution.fields.H[j, i])
    status = blocks.largest(drawn_status(solution.fields)[j, i])
    norm = film_scale(blocks, film, status)
    image = axes.pcolormesh(
        blocks.X, blocks.Y, np.maximum(film, norm.vmin), norm=norm, shading="nearest", rasterized=True
    )
    bar, levels = figure.colorbar(image, ax=axes, label="gap, nm", extend="max"), levels_of(norm)
    bar.set_ticks(levels, labels=[f"{level:g}" for level in levels], minor=False)
    bar.minorticks_off()
    contact = status == CONTACT
    if contact.any():
        axes.contourf(blocks.X, blocks.Y, contact, (0.5, 1.5), colors=[STATUS_COLOURS[CONTACT]])
        legend_below(axes, [Patch(color=STATUS_COLOURS[CONTACT], label="contact")])
    _finish(axes, solution, "gap")


def _finish(axes, solution, name):
    X, Y = position_labels(solution)
    axes.set(xlabel=X, ylabel=Y, title=name, aspect="equal")
    add_arrow(axes, solution.contact)


def _profile(axes, solution, heights):
    """Heights of a line, and where it is in contact."""
    X, contact = solution.mesh.X, solution.fields.status[0] == CONTACT
    axes.plot(X, 1e9 * heights, color=FILM)
    if contact.any():
        black = STATUS_COLOURS[CONTACT]
        legend_below(axes, axes.plot(X[contact], 1e9 * heights[contact], ".", color=black, label="contact"))
    axes.set(xlabel=position_labels(solution)[0], ylabel="height, nm (a peak is positive)", title="heights")


def _distribution(axes, solution, heights):
    """The nodes within the Hertz semi-axes, beside the normal distribution of the surface's rms."""
    mesh, contact = solution.mesh, solution.contact
    nm, rms = 1e9 * heights[np.ix_(np.abs(mesh.Y) <= 1.0, np.abs(mesh.X) <= 1.0)], 1e9 * contact.roughness
    nm = (nm - nm.mean()).ravel()
    axes.hist(nm, BINS, density=True, color=BARS)
    handles = [Patch(color=BARS, label="within the Hertz contact")]
    if rms > 0.0:
        z = np.linspace(nm.min(), nm.max(), 200)
        normal = np.exp(-0.5 * (z / rms) ** 2) / (rms * np.sqrt(2.0 * np.pi))
        handles += axes.plot(z, normal, "--", color=HERTZ, label="normal, of the same rms")
    axes.set(
        xlabel="height about the mean, nm", ylabel="per nm",
        title=f"Sq {rms:.4g} nm, Ssk {contact.skewness:.2g}",
    )  # fmt: skip
    legend_below(axes, handles)
