"""What all maps have in common: true to scale in mm, with outlines, Hertz ellipse and motion."""

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse, FancyArrowPatch, Patch
from matplotlib.patheffects import withStroke
from scipy.ndimage import distance_transform_edt, gaussian_filter, label, zoom

from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, NAMES
from mgehl.output.pictures.style import CONTACT_COLOUR, HIDDEN
from mgehl.output.pictures.zone import hertz_zone

OVERLAP = len(NAMES)
"""Drawn as a status: nodes outside of contact whose gap is negative."""
ARROW = 0.13
"""Length of the arrow that shows the motion, over the shorter side of the map."""
FINE, LEAST, TIMES = 800, 2, 4
"""Points along a side that outlines are drawn through, and for each node how many at the least and most."""
FEW, ROUNDING = 12, 0.5
"""Nodes of a set below which its edge is not rounded, and the width of the rounding in nodes."""
TICKS, BAR = 7, 0.04
"""Steps of the numbers along the longer side of a map; width of a colour bar over that side."""
_EDGE = (withStroke(linewidth=3.0, foreground="white"),)


def drawn_status(fields):
    """The status of each node, with nodes whose gap is negative without contact as OVERLAP."""
    return np.where((fields.H < 0.0) & (fields.status != CONTACT), OVERLAP, fields.status)


def draw_image(axes, blocks, values, norm=None, cmap=None):
    """Values of blocks as an image that is smooth between them, true to scale."""
    axes.set_facecolor(HIDDEN)
    image = axes.imshow(
        values, origin="lower", extent=blocks.extent, norm=norm, cmap=cmap, interpolation="bilinear"
    )  # fmt: skip
    true_to_scale(axes, blocks)
    return image


def true_to_scale(axes, blocks):
    """The limits of a map of blocks, its sides alike, and no more numbers along a side than it takes."""
    left, right, bottom, top = blocks.limits
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
    axes.locator_params(axis="x", nbins=_ticks(right - left, top - bottom), min_n_ticks=1)
    axes.locator_params(axis="y", nbins=_ticks(top - bottom, right - left), min_n_ticks=1)


def _ticks(length, other):
    return max(1, round(TICKS * min(1.0, length / other)))


def colour_bar(axes, image, label, **options):
    """A colour bar as high as the map, whatever its width."""
    left, right, bottom, top = image.get_extent()
    wide = BAR * max(1.0, (top - bottom) / (right - left))
    beside = axes.inset_axes((1.0 + wide, 0.0, wide, 1.0))
    return axes.figure.colorbar(image, cax=beside, label=label, **options)


def grey_beyond(axes, blocks, values, limit):
    """Cover films above the limit in grey; return handles of the legend."""
    if min(values.shape) < 2 or not (values > limit).any():
        return []
    axes.contourf(blocks.X, blocks.Y, values, (limit, np.inf), colors=[HIDDEN])
    return [Patch(color=HIDDEN, label=f"thicker than {float(f'{limit:.3g}'):.10g} nm")]


def between(blocks, values):
    """Points along X and Y and values between those of blocks, for lines without corners."""
    times = max(LEAST, min(TIMES, FINE // max(values.shape)))
    fine = zoom(np.asarray(values, dtype=float), times, order=3, mode="nearest")
    X, Y = (
        np.interp(np.linspace(0, len(line) - 1, n), np.arange(len(line)), line)
        for line, n in zip((blocks.X, blocks.Y), fine.shape[::-1], strict=True)
    )
    return X, Y, fine


def rounded(blocks, mask):
    """As `between`, of a set of nodes, 0.5 on its edge: the steps of a long one are rounded off.

    Lines as wide as a node stay, and so do single nodes, which rounding would wipe out.
    """
    labels, _ = label(mask, np.ones((3, 3)))
    few = mask & (np.bincount(labels.ravel())[labels] < FEW)
    X, Y, large = between(blocks, mask & ~few)
    times = len(Y) / len(blocks.Y)
    smooth = gaussian_filter(large, ROUNDING * times, mode="nearest")
    return X, Y, np.maximum(smooth, between(blocks, few)[2]) if few.any() else smooth


def outline(axes, blocks, status, filled):
    """Contact and cavitation outlined, contact in its colour where it is `filled`; their handles."""
    return [*outline_contact(axes, blocks, status, filled), *_outline_cavity(axes, blocks, status)]


def outline_contact(axes, blocks, status, filled):
    """As `outline`, of the contact alone."""
    contact = status == CONTACT
    if not contact.any() or min(status.shape) < 2:  # no line can be drawn between nodes
        return []
    X, Y, fine = rounded(blocks, contact)
    if filled:
        axes.contourf(X, Y, fine, (0.5, 2.0), colors=[CONTACT_COLOUR])
    axes.contour(X, Y, fine, (0.5,), colors=CONTACT_COLOUR, linewidths=0.8)
    face = CONTACT_COLOUR if filled else "none"
    return [Patch(facecolor=face, edgecolor=CONTACT_COLOUR, label="contact")]


def _outline_cavity(axes, blocks, status):
    cavitated, given = status == CAVITATED, status == BOUNDARY
    if not cavitated.any() or min(status.shape) < 2:
        return []
    # The boundary's pressure is given: it is no end of the cavity, which goes on there as beside it.
    nearest = distance_transform_edt(given, return_distances=False, return_indices=True)
    X, Y, fine = rounded(blocks, cavitated[tuple(nearest)])
    # Black on white is seen on the darkest and on the brightest of the map's colours.
    axes.contour(X, Y, fine, (0.5,), colors="white", linewidths=2.2)
    axes.contour(X, Y, fine, (0.5,), colors="black", linestyles="--", linewidths=1)
    return [Line2D([], [], color="black", linestyle="--", linewidth=1, label="cavitation")]


def draw_hertz(axes, contact):
    """The edge of the dry contact of smooth half-spaces; its handle."""
    zone = hertz_zone(contact)
    line = {"color": "black", "linestyle": ":", "linewidth": 1.3}
    axes.add_patch(
        Ellipse((0.0, 0.0), 2 * zone.half_x, 2 * zone.half_y, fill=False, path_effects=_EDGE, **line)
    )
    return Line2D([], [], label=hertz_words(contact), **line)


def hertz_words(contact):
    """What the edge of the dry contact is called: of a coated body it is not the coated one's."""
    a, b = f"{1e3 * contact.x_scale:.3g}", f"{1e3 * contact.y_scale:.3g}"
    size = f"a = b = {a} mm" if a == b else f"a = {a} mm, b = {b} mm"
    return f"Hertz{'' if contact.deformation is None else ', uncoated'}: {size}"


def add_arrow(axes, contact):
    """An arrow of the motion of loaded bodies in the lower left corner; the map's limits are set."""
    if not contact.is_loaded or contact.is_at_rest:
        return
    tail, head = arrow_ends(contact, axes.get_xlim(), axes.get_ylim())
    axes.add_patch(FancyArrowPatch(
        tail, head, arrowstyle="-|>", mutation_scale=11, shrinkA=0, shrinkB=0, color="black",
        linewidth=1.4, path_effects=_EDGE, zorder=5,
    ))  # fmt: skip


def arrow_ends(contact, x_limits, y_limits):
    """Tail and head (x, y) of the arrow on a map of these limits, which is true to scale."""
    length = ARROW * min(np.ptp(x_limits), np.ptp(y_limits))
    half = 0.5 * length * np.asarray(contact.motion) / np.hypot(*contact.motion)
    middle = np.array((x_limits[0], y_limits[0])) + 0.75 * length
    return middle - half, middle + half
