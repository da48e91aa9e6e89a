"""The picture of a rough or wavy surface: heights with the contact on them, gap, distribution."""

import numpy as np
from matplotlib.patches import Patch

from mgehl.discretization.status import CONTACT
from mgehl.output.mixed_words import mixed_note
from mgehl.output.pictures import maps
from mgehl.output.pictures.plane import Plane
from mgehl.output.pictures.style import CONTACT_COLOUR, FILM, HERTZ, SMALL, legend_below, subplots
from mgehl.output.pictures.titles import gap_words, position_labels, title
from mgehl.output.surface import surface_words

BARS = "0.7"
BINS = 61
"""Of the histogram."""
EDGES = 0.5, 99.5
"""Per cent of the heights that the map's scale begins and ends at."""
HEIGHT = "height, nm (a peak is positive)"


def surface_picture(solution):
    """Figure of a solution whose contact has a surface; of a line contact its heights along x."""
    heights = solution.heights
    panels = 2 if solution.mesh.is_line else 3
    figure, axes = subplots(1, panels, size=(1.0 + 4.4 * panels, 4.4))
    if solution.mesh.is_line:
        _profile(axes[0], solution, 1e9 * heights[0])
    else:
        _height_map(axes[0], solution, heights)
        legend_below(axes[1], maps.draw_film(axes[1], solution, SMALL), columns=2)
        axes[1].set_title(gap_words(solution.contact)[0])
    _distribution(axes[-1], solution, heights)
    notes = surface_words(*_seen(solution.result)), mixed_note(solution.result.mixed)
    figure.suptitle("\n".join(filter(None, (f"surface, {title(solution)}", *notes))))
    return figure


def _seen(result):
    """Verdict on the grid and nodes in the shortest wave."""
    if found := result.resolution:
        return found.surface, found.surface_nodes
    return (result.surface.verdict, result.surface.wave_nodes) if result.surface else ("", None)


def _height_map(axes, solution, heights):
    plane = Plane(solution, SMALL)
    nm = plane.blocks.largest(1e9 * heights[plane.part])
    low, high = np.percentile(nm, EDGES)
    image = maps.draw_image(axes, plane, nm, "bilinear", vmin=low, vmax=high, cmap="gray")
    maps.bar(axes, plane, image, (0.0, 1.0), label=HEIGHT, extend="both")
    handles = maps.draw_sets(axes, plane)
    legend_below(axes, [*handles, *maps.finish(axes, solution, plane)], columns=2)
    axes.set_title("heights")


def _profile(axes, solution, nm):
    """Heights of a line, and where it is in contact."""
    X, contact = solution.mesh.X, solution.fields.status[0] == CONTACT
    axes.plot(X, nm, color=FILM)
    if contact.any():
        legend_below(axes, axes.plot(X[contact], nm[contact], ".", color=CONTACT_COLOUR, label="contact"))
    axes.set(xlabel=position_labels(solution)[0], ylabel=HEIGHT, title="heights")


def _distribution(axes, solution, heights):
    """The nodes within the Hertz ellipse, beside the normal distribution of the surface's rms."""
    mesh, reach = solution.mesh, solution.contact.hertz_under(solution.load_share).reach
    nm = 1e9 * heights[np.hypot(mesh.X[np.newaxis, :], mesh.Y[:, np.newaxis]) <= reach]
    nm -= nm.mean()
    mixed = solution.result.mixed
    rms = mixed.Sq_nm if mixed else solution.result.Sq_nm
    spread = nm.std()
    skewness = np.mean((nm / spread) ** 3) if spread else 0.0
    axes.hist(nm, BINS, density=True, color=BARS)
    handles = [Patch(color=BARS, label="within the Hertz contact")]
    if rms > 0.0:
        z = np.linspace(nm.min(), nm.max(), 200)
        normal = np.exp(-0.5 * (z / rms) ** 2) / (rms * np.sqrt(2.0 * np.pi))
        handles += axes.plot(z, normal, "--", color=HERTZ, label="normal, of the same rms")
    said = f"Sq {rms:.4g} nm, Ssk {skewness:.2g}"
    axes.set(xlabel="height about the mean, nm", ylabel="per nm", title=said)
    legend_below(axes, handles)
