"""The one status of a node, and what contact closes.

All fourteen neighbourhoods of [Liu sec. 3.2.2-3.2.5] are one rule: a face is closed, for
Poiseuille and Couette flow alike, when either of its two nodes is in solid contact.
"""

import numpy as np

BOUNDARY, LUBRICATED, CAVITATED, CONTACT = np.int8(0), np.int8(1), np.int8(2), np.int8(3)
NAMES = ("boundary", "lubricated", "cavitated", "contact")


def open_x_faces(status):
    """True where the face between nodes i and i+1 lets fluid through: (..., nx - 1)."""
    contact = status == CONTACT
    return ~(contact[..., :-1] | contact[..., 1:])


def open_y_faces(status):
    """True where the face between lines j and j+1 lets fluid through: (lines - 1, nx)."""
    contact = status == CONTACT
    return ~(contact[:-1] | contact[1:])


def beside_contact(status):
    """Nodes with one of their four faces closed by contact; `status` ghosted, the result (lines, nx)."""
    x_faces, y_faces = open_x_faces(status[1:-1]), open_y_faces(status)
    closed = ~(y_faces[:-1] & y_faces[1:])
    closed[:, 1:] |= ~x_faces
    closed[:, :-1] |= ~x_faces
    return closed


def enclosed(status):
    """Fluid nodes whose west and east faces are both closed: they belong to the contact.

    [Liu sec. 3.2.5, last paragraph]. `status` may have any number of lines.
    """
    contact = status == CONTACT
    shut = np.zeros_like(contact)
    shut[..., 1:-1] = contact[..., :-2] & contact[..., 2:]
    return shut & ((status == LUBRICATED) | (status == CAVITATED))


def close_gaps(status):
    """Turn enclosed fluid nodes into contact, in place; return how many were turned.

    One pass suffices: a turned node has contact on both sides already, so it encloses no other.
    """
    shut = enclosed(status)
    status[shut] = CONTACT
    return int(shut.sum())


def largest_fluid_neighbour(P, status):
    """Largest pressure of the four fluid neighbours of each node, -inf without any.

    `P` and `status` are ghosted, (lines + 2, nx); the result is (lines, nx). Boundary nodes
    count as fluid: their pressure is known. This is the right-hand side of [Liu eq. 2].
    """
    fluid = np.where(status == CONTACT, -np.inf, P)
    result = np.maximum(fluid[:-2], fluid[2:])
    result[:, 1:] = np.maximum(result[:, 1:], fluid[1:-1, :-1])
    result[:, :-1] = np.maximum(result[:, :-1], fluid[1:-1, 1:])
    return result
