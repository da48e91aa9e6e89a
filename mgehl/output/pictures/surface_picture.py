"""The picture of a rough or wavy surface: heights with the contact on them, gap, distribution."""

import numpy as np
from matplotlib.colors import Normalize
from matplotlib.patches import Patch

from mgehl.discretization.status import CONTACT
from mgehl.output.mixed_words import mixed_note
from mgehl.output.pictures.lines import film_words
from mgehl.output.pictures.maps import draw_film, view
from mgehl.output.pictures.plane import (
    add_arrow,
    colour_bar,
    draw_hertz,
    draw_image,
    drawn_status,
    outline_contact,
)
from mgehl.output.pictures.style import FILM, HERTZ, STATUS_COLOURS, legend_below, subplots
from mgehl.output.pictures.titles import map_labels, position_labels, title
from mgehl.output.surface import surface_verdict, surface_words, wave_nodes

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
        _height_map(axes[0], solution, heights)
        what = film_words(solution.contact)[0]
        legend_below(axes[1], draw_film(axes[1], solution, what, MOST), columns=2)
        axes[1].set_title(what)
    _distribution(axes[-1], solution, heights)
    nodes = wave_nodes(solution.contact, solution.mesh)
    shown = surface_words(surface_verdict(solution.contact, nodes), nodes)
    notes = shown, mixed_note(solution.result.mixed)
    figure.suptitle("\n".join(filter(None, (f"surface, {title(solution)}", *notes))))
    return figure


def heights_of(solution):
    """Heights of the nodes in m, a peak positive, (ny, nx)."""
    shape = solution.mesh.ny, solution.mesh.nx
    heights = solution.contact.surface.height(solution.x[None, :], solution.y[:, None])
    return np.broadcast_to(heights, shape)


def _height_map(axes, solution, heights):
    blocks, nodes = view(solution, MOST)
    nm = blocks.largest(1e9 * heights[nodes])
    low, high = np.percentile(nm, EDGES)
    image = draw_image(axes, blocks, nm, Normalize(low, high), "gray")
    colour_bar(axes, image, "height, nm (a peak is positive)", extend="both")
    status = blocks.largest(drawn_status(solution.fields)[nodes])
    contact = outline_contact(axes, blocks, status, filled=True)
    x, y = map_labels(solution)
    axes.set(xlabel=x, ylabel=y, title="heights")
    add_arrow(axes, solution.contact)
    legend_below(axes, [*contact, draw_hertz(axes, solution.contact)])


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
