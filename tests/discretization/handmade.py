"""Ghosted arrays made by hand: one line along X or along Y, with what is beyond the domain around it."""

import numpy as np

from mgehl.discretization import faces
from mgehl.discretization.axes import HALO, Axis
from mgehl.discretization.status import WALL

ALONG = ("x", "y")


def ghosted(lines, beyond=0.0):
    """The lines (ny, nx) of one rank that has all of them, `beyond` the first and the last."""
    return np.pad(np.asarray(lines), ((HALO, HALO), (0, 0)), constant_values=beyond)


def walled(status):
    return ghosted(status, WALL)


def flows(fluid, status, axis, scheme, **how):
    """`faces.flows` at the mobility of the fluid."""
    mobility = faces.mobility_of_faces(fluid, axis, scheme)
    return faces.flows(fluid, status, axis, scheme, mobility, **how)


def conductances(fluid, status, axis, scheme):
    """`faces.conductances` at the mobility of the fluid."""
    mobility = faces.mobility_of_faces(fluid, axis, scheme)
    return faces.conductances(status, axis, scheme, mobility)


class Row:
    """The words for one row of nodes along an axis, so that a test says them once for both."""

    def __init__(self, along):
        self.along_x = along == "x"

    def axis(self, cell=1.0, distance=1.0, couette=1.0):
        return Axis(int(self.along_x), cell, distance, couette)

    def lay(self, values, beyond=0.0):
        """The values (n,), or (rows, n), along the axis: ghosted."""
        values = np.atleast_2d(values)
        return ghosted(values if self.along_x else values.T, beyond)

    def status(self, values):
        return self.lay(values, WALL)

    def faces(self, array):
        """Of an array of faces those between the nodes of the row, (n - 1,) or (rows, n - 1)."""
        found = array if self.along_x else array[1:-1].T
        return found[0] if len(found) == 1 else found
