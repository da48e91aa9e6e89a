"""How well a grid shows a surface, and the words for it in a run and in `mgehl check`."""

from math import inf, isinf

from mgehl.kinds.surface import parts_of
from mgehl.model.surface import Measured

RESOLVED_NODES, SEEN_NODES = 8.0, 4.0
"""Nodes in the shortest wave from which on it is resolved, and below which the grid shows another one."""

SMOOTH, RESOLVED, COARSE, GRIDS, UNKNOWN = "smooth", "resolved", "coarse", "grid-determined", "unknown"
"""Verdicts; the last of runs that older versions made."""


def wave_nodes(contact, mesh):
    """Nodes of a mesh in the shortest wave of a contact's surface; `inf` without waves."""
    return inf if contact.surface is None else contact.shortest_wave(mesh) / contact.longest_cell(mesh)


def surface_verdict(contact, nodes):
    """The verdict on so many nodes in the shortest wave."""
    if contact.surface is None:
        return SMOOTH
    if nodes >= RESOLVED_NODES:
        return RESOLVED
    return COARSE if nodes >= SEEN_NODES else GRIDS


ADVICE = {
    RESOLVED: "resolved",
    COARSE: f"coarse (below {RESOLVED_NODES:g})",
    GRIDS: f"THE SURFACE IS THE GRID'S (below {SEEN_NODES:g}): the grid shows other waves than it has",
}


def surface_words(verdict, nodes):
    """A verdict in words; nothing of smooth bodies."""
    if verdict not in ADVICE:
        return ""
    if nodes is None or isinf(nodes):
        return "it has no waves"
    return f"{nodes:.1f} nodes in its shortest wave: {ADVICE[verdict]}"


def surface_lines(config, contact, mesh):
    """Lines of `mgehl check` about a surface: its heights in the contact, its waves, its place."""
    if contact.surface is None:
        return
    rms, shortest = contact.roughness, contact.shortest_wave(mesh)
    nodes = wave_nodes(contact, mesh)
    ratio = f"{contact.expected_film / rms:.3g}" if rms else "without end"
    yield (
        f"surface    Sq {1e9 * rms:.4g} nm   Ssk {contact.skewness:.3g} (within the Hertz contact)   "
        f"lambda {ratio} (the formula's film over Sq)"
    )
    verdict = surface_verdict(contact, nodes)
    wave = "" if isinf(shortest) else f"shortest wavelength {1e6 * shortest:.4g} um, "
    yield f"           {wave}{surface_words(verdict, nodes)}{_recommended(verdict, nodes, mesh)}"
    yield "           a peak is positive and lowers the gap; the rough body stands still, the other has 2 u"
    for key, part in parts_of(config):
        yield from _part_lines(key, part, contact, mesh)


def _recommended(verdict, nodes, mesh):
    """How many nodes would resolve the shortest wave, where these do not."""
    if verdict == RESOLVED:
        return ""
    needed = mesh.nx
    while nodes * (needed - 1) / (mesh.nx - 1) < RESOLVED_NODES:
        needed = 2 * needed - 1
    return f"; resolved from {needed} nodes on, or leave its short waves out"


def _part_lines(key, part, contact, mesh):
    """Lines about one body's surface: its sign, its size, its tilt and its end."""
    if part.function is not None:
        yield f"           {key}: in earlier versions such heights added to the gap"
    if isinstance(part, Measured):
        heights = part.heights
        (rows, columns), (width, length) = heights.values.shape, heights.size
        yield f"           {key}: {columns} x {rows} points, {1e6 * width:.4g} um by {1e6 * length:.4g} um"
        if heights.tilt > contact.roughness:
            yield (
                f"           it is tilted by {1e9 * heights.tilt:.4g} nm from edge to edge: "
                'remove = "tilt" levels it'
            )
        x, y = mesh.X * contact.x_scale, mesh.Y * contact.y_scale
        if not part.reaches(x[[0, -1]][None, :], y[[0, -1]][:, None]).all():
            yield "           it ends within the domain: beyond its edge the edge's heights go on"
