"""The domain of a loaded contact where it is "auto"."""

from dataclasses import replace

from mgehl.config_value import AUTO, FARTHEST
from mgehl.model.room import domain_for
from mgehl.model.starvation import Starvation


def settled(config, contact):
    """The `Config` with numbers in the place of "auto".

    The domain is as small as the film of a formula and the peaks that may touch allow, with most room
    upstream. Layered bodies count as half-spaces whose contact is as wide.
    """
    grid = config.grid
    names = open_ends(grid, contact)
    if not names:
        return config
    starvation = Starvation(contact, contact.flooded_film)
    found = dict(zip("xy", domain_for(starvation, grid.nodes, FARTHEST), strict=True))
    return replace(config, grid=replace(grid, **{name: found[name] for name in names}))


def open_ends(grid, contact):
    """The axes of a grid's section that are "auto"."""
    return [name for name in ("x" if contact.is_plane else "xy") if getattr(grid, name) == AUTO]
