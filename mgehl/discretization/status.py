"""What a node is: film, cavity, solid contact or boundary; and which faces contact closes.

All fourteen neighbourhoods of [Liu sec. 3.2.2-3.2.5] are one rule: a face is closed, for either flow, when
either of its two nodes is solid. What equation a node has is another matter (`rows`).
"""

import numpy as np

from mgehl.discretization.axes import own

BOUNDARY, LUBRICATED, CAVITATED, CONTACT, WALL = (np.int8(kind) for kind in range(5))
"""WALL is beyond the domain: the ghost lines outside of it. Nothing flows there."""
NAMES = ("boundary", "lubricated", "cavitated", "contact")

APART = "apart"
"""What LUBRICATED is called where there is no fluid."""


def names(is_dry):
    """What the nodes of a run are called, in the order of their numbers."""
    return tuple(APART if is_dry and name == NAMES[LUBRICATED] else name for name in NAMES)


def is_fluid(status):
    """Nodes with a gap that fluid may fill: film and cavities."""
    return (status == LUBRICATED) | (status == CAVITATED)


def is_solid(status, contact=True):
    """Nodes that let nothing through: walls, and `contact` where its law says so."""
    return status >= (CONTACT if contact else WALL)


def open_faces(solid, axis):
    """True where a face along `axis` lets fluid through: neither of its nodes is `solid`, ghosted."""
    return ~(axis.at(solid, 0) | axis.at(solid, 1))


def beside_contact(status, axes):
    """Nodes with one of their faces closed by contact; `status` ghosted, the result (lines, nx)."""
    contact = status == CONTACT
    result = own(contact).copy()
    for axis in axes:
        result |= axis.beside(contact, -1) | axis.beside(contact, 1)
    return result


def enclosed(status, axes):
    """Fluid nodes shut in from both sides along every axis of motion: they belong to the contact. [Liu sec.
    3.2.5, last paragraph]. `status` ghosted, the result (lines, nx)."""
    solid = status == CONTACT
    shut = is_fluid(own(status))
    for axis in axes:
        if axis.couette:
            shut &= axis.beside(solid, -1) & axis.beside(solid, 1)
    return shut


def largest_fluid_neighbour(P, status, axes):
    """Largest pressure of the fluid neighbours of each node, (lines, nx), -inf without any: the right-hand
    side of [Liu eq. 2]. `P` and `status` are ghosted; boundary nodes count as fluid."""
    fluid = np.where(is_solid(status), -np.inf, P)
    result = np.full(own(status).shape, -np.inf)
    for axis in axes:
        for side in (-1, 1):
            np.maximum(result, axis.beside(fluid, side), out=result)
    return result
