"""The domain of a loaded contact where it is "auto"."""

from dataclasses import replace

from mgehl.config_value import AUTO, FARTHEST
from mgehl.model.room import domain_for
from mgehl.model.starvation import Starvation


def settled(config, contact):
    """The `Config` with numbers for "auto": as small as the film of a formula allows, along the motion.

    A surface of the user's own is not asked: the domain is that of the smooth bodies. Layered bodies are
    taken for half-spaces whose contact is as wide.
    """
    grid = config.grid
    if AUTO not in (grid.x, grid.y):
        return config
    x, y = domain_for(Starvation(contact, contact.flooded_film), grid.nodes, FARTHEST)
    found = {"x": x} if contact.is_plane else {"x": x, "y": y}
    found = {name: ends for name, ends in found.items() if getattr(grid, name) == AUTO}
    return replace(config, grid=replace(grid, **found))
