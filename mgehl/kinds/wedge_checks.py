"""Checks of a wedge bearing: whether values that are allowed one by one fit each other and the grid."""

from mgehl.errors import ConfigError

LARGEST_ASPECT = 100.0
"""Largest ratio of a pad's length and width."""

STEEPEST = 0.1
"""Largest slope of a pad."""

FEWEST_CELLS = 2
"""Cells that a pillar or a pocket must have, and the distance from the exit to the line of no gap."""


def check_pad(wedge):
    """A pad has a length, and a slope that is not too steep; its pocket lies within it."""
    if wedge.by_films:
        steepness = abs(wedge.inlet_film - wedge.exit_film) / wedge.length
        words = f"the slope between these films would be {steepness:.2g}; it must be at most {STEEPEST:g}"
        _demand(steepness <= STEEPEST, wedge, "length", words)
    else:
        _demand(wedge.exit < wedge.inlet, wedge, "inlet", f"must be above wedge.exit = {wedge.exit:g}")
    if not wedge.pocket_depth:
        return
    (first, last), wide = wedge.ends, wedge.pocket_width or 0.0
    if not first <= wedge.pocket_from < wedge.pocket_to <= last:
        raise ConfigError(
            f"wedge.pocket_from = {wedge.pocket_from:g}, wedge.pocket_to = {wedge.pocket_to:g}: the first "
            f"must lie before the second, both on the pad from {first:g} to {last:g}"
        )
    words = f"must be at most the pad's wedge.width = {wedge.width:g}"
    _demand(wide <= wedge.width, wedge, "pocket_width", words)


def check_on_grid(wedge, contact, mesh, nodes):
    """The pad is a plate, its gap, its pillar and its pocket are larger than cells of the grid."""
    length, (dx, dy) = wedge.ends[1] - wedge.ends[0], cell_of(contact, mesh)
    is_plate = contact.is_line or 1.0 / LARGEST_ASPECT <= wedge.width / length <= LARGEST_ASPECT
    words = f"must be within a factor of {LARGEST_ASPECT:g} of the pad's length of {length:g}"
    _demand(is_plate, wedge, "width", words)
    least = FEWEST_CELLS * dx
    few = f"must be at least {FEWEST_CELLS} cells from the line of no gap, {least:.3g} with {nodes} nodes"
    _demand(wedge.by_films or wedge.exit >= least, wedge, "exit", few)
    if wedge.pillar != "none":
        _check_pillar(wedge, FEWEST_CELLS * max(dx, dy), nodes)
    if contact.pocket:
        _check_pocket(wedge, (dx, 0.0 if mesh.is_line else dy), nodes)


def cell_of(bearing, mesh):
    """Sides of a cell in m."""
    return mesh.dX * bearing.x_scale, mesh.dY * bearing.y_scale


def _check_pillar(wedge, smallest, nodes):
    """A pillar stands within the pad and is larger than a few cells."""
    (first, last), size = wedge.ends, wedge.pillar_size
    fewest = f"must be at least {FEWEST_CELLS} cells, {smallest:.3g} with {nodes} nodes"
    _demand(size >= smallest, wedge, "pillar_size", fewest)
    one, other = ("inlet", "exit") if wedge.by_films else ("exit", "inlet")
    between = f"between the {one} at {first:g} and the {other} at {last:g}"
    stands = f"the pillar of {size:g} m must stand"
    is_on = first < wedge.pillar_x - 0.5 * size and wedge.pillar_x + 0.5 * size < last
    _demand(is_on, wedge, "pillar_x", f"{stands} {between}")
    is_within = abs(wedge.pillar_y) + 0.5 * size < 0.5 * wedge.width
    _demand(is_within, wedge, "pillar_y", f"{stands} within the width of {wedge.width:g}")


def _check_pocket(wedge, cell, nodes):
    """A pocket has a few cells; one that is as wide as the pad has them."""
    along, across = wedge.pocket_to - wedge.pocket_from, wedge.pocket_width or float("inf")
    for key, size, dx in zip(("pocket_to", "pocket_width"), (along, across), cell, strict=True):
        least = FEWEST_CELLS * dx
        few = f"{FEWEST_CELLS} cells long and wide, {least:.3g} with {nodes} nodes"
        _demand(size >= least, wedge, key, f"the pocket must be at least {few}")


def _demand(holds, wedge, key, words):
    """Raise ConfigError, in some words about a key, unless something holds."""
    if not holds:
        raise ConfigError(f"wedge.{key} = {getattr(wedge, key):g}: {words}")
