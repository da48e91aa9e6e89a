"""How well a grid shows a surface, and the words for it in a run and in `mgehl check`."""

from dataclasses import dataclass
from math import isfinite

from mgehl.kinds.surface import parts_of
from mgehl.kinds.time import stands_still
from mgehl.model.surface import Measured
from mgehl.model.surface.doubts import jumped, outstanding

RESOLVED_NODES, SEEN_NODES = 8.0, 4.0
"""Nodes in the shortest wave from which on it is resolved, and below which the grid shows another one."""

HARDLY_CURVED = 20.0
"""Radius of a surface's form over the contact's larger one from which on it changes no contact."""

SMOOTHEST = 2e-10
"""Rms in m below which heights are hardly those of a surface: wafers and mica have as much."""

ROUGHEST = 20e-6
"""Sq in m above which it is doubted, too."""

SMOOTH, RESOLVED, COARSE, GRIDS = "smooth", "resolved", "coarse", "grid-determined"
"""Verdicts."""


@dataclass(frozen=True)
class SurfaceOnGrid:
    """How well a grid shows the surface of a contact."""

    verdict: str
    wave_nodes: float | None
    """In its shortest wave; None without waves."""

    @classmethod
    def of(cls, contact, mesh):
        """That of a contact on a mesh."""
        if contact.surface is None:
            return cls(SMOOTH, None)
        nodes = contact.shortest_wave(mesh) / contact.longest_cell(mesh)
        verdict = RESOLVED if nodes >= RESOLVED_NODES else COARSE if nodes >= SEEN_NODES else GRIDS
        return cls(verdict, nodes if isfinite(nodes) else None)


ADVICE = {
    RESOLVED: "resolved",
    COARSE: f"coarse (below {RESOLVED_NODES:g})",
    GRIDS: f"THE SURFACE IS THE GRID'S (below {SEEN_NODES:g}): the grid shows other waves than it has",
}


def surface_words(verdict, nodes):
    """A verdict in words; nothing of smooth bodies."""
    if verdict not in ADVICE:
        return ""
    if nodes is None:
        return "it has no waves"
    return f"{nodes:.1f} nodes in its shortest wave: {ADVICE[verdict]}"


BEARABLE = 50.0
"""GPa: no solid bears more."""


def beyond_solids(GPa):
    """What to think of a larger pressure, in words that follow it; nothing of others."""
    return " (no solid bears that: does a point of the heights stand out?)" if GPa > BEARABLE else ""


def surface_lines(config, contact, mesh):
    """Lines of `mgehl check` about a surface: its heights in the contact, its waves, its place."""
    if contact.surface is None:
        return
    rms, seen = contact.roughness, SurfaceOnGrid.of(contact, mesh)
    verdict, nodes = seen.verdict, seen.wave_nodes
    begun = " at the beginning" if config.is_in_time else ""
    film = "" if config.is_dry or stands_still(config) else _film_over(contact)
    heights = f"Sq {1e9 * rms:.4g} nm   Ssk {contact.skewness:.3g}"
    yield f"surface    {heights} (within the Hertz contact{begun}){film}"
    # A filter's cut-off leaves a part of shorter ones.
    by_heights = any(part.function or isinstance(part, Measured) for _, part in parts_of(config))
    called = "shortest wave seen in the spectrum" if by_heights else "shortest wavelength"
    wave = nodes and f"{called} {1e6 * nodes * contact.longest_cell(mesh):.4g} um, "
    yield f"           {wave or ''}{surface_words(verdict, nodes)}{_recommended(verdict, nodes, mesh)}"
    stands = not (config.is_in_time or config.is_dry)
    still = "; the rough body stands still, the other has 2 u" if stands else ""
    yield f"           a peak is positive and lowers the gap{still}"
    if contact.is_line and any(_varies_along_y(part) for _, part in parts_of(config)):
        yield "           heights are those at y = 0, as if they were the same all along y"
    for key, part in parts_of(config):
        yield from _part_lines(key, part, contact, mesh)
    yield from (f"warning    {words}" for words in surface_doubts(config, contact))


def _film_over(contact):
    """Lambda in words."""
    ratio = f"{contact.lambda_ratio:.3g}" if contact.lambda_ratio else "without end"
    return f"   lambda {ratio} (the formula's film {1e9 * contact.expected_film:.4g} nm over Sq)"


def _varies_along_y(surface):
    """Whether heights vary along y, as all of a file over a rectangle may."""
    is_profile = isinstance(surface, Measured) and surface.heights.is_profile
    return not is_profile and surface.varies_along((0.0, 1.0))


def surface_doubts(config, contact):
    """Lines about heights that may be errors: they are what a file says, and hardly what was measured."""
    for key, part in parts_of(config):
        if isinstance(part, Measured):
            doubts = *_doubts(part.heights), *_form_doubts(part.heights, contact)
            yield from (f"{key}: {words}" for words in doubts)
    rms, than = contact.roughness, None
    if 0.0 < rms < SMOOTHEST and not config.is_in_time:
        than = f"{1e9 * rms:.2g} nm within the Hertz contact, less than any but wafers have"
    elif rms > ROUGHEST:
        than = f"{1e6 * rms:.3g} um within the Hertz contact, more than a surface that rolls or slides has"
    if than:
        yield f"Sq is {than}: are the units of the heights right?"


def _doubts(heights):
    """Doubts about the points of one file."""
    if heights.doubt:
        yield heights.doubt
    if heights.filled:
        yield f"{heights.filled} of {heights.own_points.size} points were holes and are filled smoothly"
    count, point = heights.repeated
    if count:
        yield (
            f"{count} points, the first in row {point.row}, column {point.column}, have the same height of "
            f"{1e6 * point.height:.4g} um, apart from all others: a missing value?"
        )
    count, point = outstanding(heights.own_points, min(heights.dx, heights.dy))
    if count:
        stand = "1 point stands" if count == 1 else f"{count} points stand"
        means = "such a point may bear all of the load" if point.height > 0.0 else "a missing value?"
        yield (
            f"{stand} out of all neighbours, row {point.row}, column {point.column} most, by "
            f"{1e6 * point.height:.4g} um: {means}"
        )
    # A profile's points are no lines.
    name, lines, apart = jumped(heights.points) if not heights.is_profile else ("", [], 0.0)
    if lines:
        yield (
            f"{name} {', '.join(map(str, lines))}: the whole {name} lies {1e9 * apart:.4g} nm off its "
            "neighbours: a scan line that jumped, or a scratch one point wide?"
        )


def _form_doubts(heights, contact):
    """Doubts about the form of one file in a contact, whose own radii the bodies have already."""
    radius = heights.form_radius
    if radius < HARDLY_CURVED * max(contact.radius_x, 0.0 if contact.is_line else contact.radius_y):
        yield (
            f"it is curved by a radius of {1e3 * radius:.3g} mm, which the bodies' radii may tell already: "
            'remove = "curvature" takes it off'
        )


def _recommended(verdict, nodes, mesh):
    """How many nodes would resolve the shortest wave, where these do not."""
    if verdict == RESOLVED:
        return ""
    needed = refined(mesh.nx, nodes, RESOLVED_NODES)
    return f"; resolved from {needed} nodes on, or leave its short waves out"


def refined(nodes, cells, needed):
    """How many nodes a side, from so many on, have the `needed` cells of what `nodes` have some of."""
    while cells < needed:
        nodes, cells = 2 * nodes - 1, 2.0 * cells
    return nodes


def _part_lines(key, part, contact, mesh):
    """Lines about one body's surface: its sign, its size, its tilt and its end."""
    if isinstance(part, Measured):
        heights = part.heights
        rows, columns = heights.values.shape
        points = f"{columns}" if heights.is_profile else f"{columns} x {rows}"
        yield f"           {key}: {points} points, {heights.size_words}"
        if heights.tilt > contact.roughness:
            yield (
                f"           it is tilted by {1e9 * heights.tilt:.4g} nm from edge to edge: "
                'remove = "tilt" levels it'
            )
        x, y = mesh.X * contact.x_scale, mesh.Y * contact.y_scale
        if not part.reaches(x[[0, -1]][None, :], y[[0, -1]][:, None]).all():
            yield "           it ends within the domain: beyond its edge the edge's heights go on"
