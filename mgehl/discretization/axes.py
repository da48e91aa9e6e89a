"""The faces of the control volumes along X and along Y: the same words for both.

Ghosted arrays are (lines + 2 HALO, nx). Faces along X lie between the nodes of the rank's own lines,
(lines, nx - 1), those along Y around its own lines, (lines + 1, nx). W and E are the nodes on either side.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.kernels import add_of_faces
from mgehl.discretization.mesh import HALO

FEW = 2**14
"""Nodes of a few lines: all that their flows are made of stays in the processor's cache."""


def few_lines(array):
    """Slices of the lines of an array (lines, nx), a few at a time."""
    lines, nx = array.shape
    few = max(1, FEW // nx)
    return [slice(first, min(first + few, lines)) for first in range(0, lines, few)]


def own(ghosted):
    """The rank's own lines of a ghosted array (a view)."""
    return ghosted[HALO:-HALO]


@dataclass(frozen=True)
class Axis:
    """One direction: its faces, and what flows through them for a gradient and for a density one."""

    number: int
    """Of the arrays' axis: 1 for X, 0 for Y."""
    cell: float
    """Side of a control volume."""
    distance: float | np.ndarray
    """Of the pressures on both sides of a face, so that the Poiseuille flow is -eps dP/distance."""
    couette: float
    """The surfaces' velocity along the axis in units of the speed, k_e times it along Y  [Liu eq. 26]."""

    def faces(self, ghosted):
        """How many faces lie behind each other along the axis, for a ghosted array."""
        return ghosted.shape[1] - 1 if self.number else len(ghosted) - 2 * HALO + 1

    def of_whole(self, ghosted):
        """Shape of an array of all faces, for a ghosted array."""
        lines = len(ghosted) - 2 * HALO
        return (lines, ghosted.shape[1] - 1) if self.number else (lines + 1, ghosted.shape[1])

    def at(self, ghosted, shift=0, first=0, last=None):
        """View at the nodes `shift` beyond W (0: W, 1: E) of the faces first ... last - 1."""
        last = self.faces(ghosted) if last is None else last
        start = shift if self.number else shift + HALO - 1
        nodes = slice(start + first, start + last)
        return ghosted[HALO:-HALO, nodes] if self.number else ghosted[nodes]

    @property
    def sides(self):
        """For compiled loops: the line of W, the line of E and the node of E of the first face."""
        return (HALO, HALO, 1) if self.number else (HALO - 1, HALO, 0)

    def reachable(self, ghosted, shifts):
        """The faces first, last between which all nodes at the `shifts` beyond W are in the array."""
        length = ghosted.shape[1] if self.number else len(ghosted)
        start, faces = (0 if self.number else HALO - 1), self.faces(ghosted)
        first = max((-start - shift for shift in shifts), default=0)
        last = min((length - start - shift for shift in shifts), default=faces)
        return max(first, 0), min(last, faces)

    def of_faces(self, array, first=0, last=None):
        """View of the faces first ... last - 1 of an array of faces."""
        return array[:, first:last] if self.number else array[first:last]

    def of_lines(self, array, lines):
        """View of the faces of some `lines` of nodes (a slice) of an array of faces."""
        return array[lines] if self.number else array[lines.start : lines.stop + 1]

    def inner(self, array):
        """View of the nodes (lines, nx) between two faces: all but the ends of lines along X."""
        return array[..., 1:-1] if self.number else array

    def beside(self, ghosted, shift):
        """What lies `shift` nodes along the axis from each, (lines, nx); lines along X end as they are."""
        if self.number:
            nx = ghosted.shape[1]
            return own(ghosted)[:, np.clip(np.arange(nx) + shift, 0, nx - 1)]
        return ghosted[HALO + shift : len(ghosted) - HALO + shift]

    def entered(self, array):
        """Of an array of faces those through which fluid enters the nodes of `inner`, going along."""
        return array[:, :-1] if self.number else array[:-1]

    def left(self, array):
        """Of an array of faces those through which it leaves them."""
        return array[:, 1:] if self.number else array[1:]

    def add_entering(self, flow, inflow):
        """Add to the inflow of the nodes, (lines, nx), what enters those of `inner` by a flow of faces."""
        add_of_faces(self.number, 0, flow, self.cell, inflow)

    def subtract_leaving(self, flow, inflow):
        """Subtract what leaves them."""
        add_of_faces(self.number, 1, flow, -self.cell, inflow)

    def offset(self, shift):
        """(lines, nodes) from a node to the one `shift` along the axis."""
        return (0, shift) if self.number else (shift, 0)


def axes_of(mesh, motion):
    """The `Axis` along X and, of a plane mesh, the one along Y; `motion` are the velocity's parts."""
    along_x = Axis(1, mesh.dX, mesh.pressure_dX, motion[0])
    if mesh.is_line:
        return (along_x,)
    return along_x, Axis(0, mesh.dY, mesh.dY / mesh.k_e**2, mesh.k_e * motion[1])
