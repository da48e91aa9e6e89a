"""Damped Jacobi x-line relaxation, distributive where the Poiseuille flow is weak."""

import numpy as np

from mgehl.discretization.bands import (
    REACH_OF_STENCIL,
    LineBands,
    distributive_nodes,
    given_nodes,
    influence_of_columns,
)
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.kernels import REACH, distribute
from mgehl.grid.events import LINES, event


class LineSmoother:
    """Python context of a PC: y = omega Q T^-1 x, T the lines' part of J Q.

    Without the distribution Q the relaxation diverges: K is long-ranged, and a band of it
    overshoots on smooth corrections; K Q decays fast enough for a band.
    """

    def __init__(self, jacobian, omega):
        self._jacobian, self._omega = jacobian, omega
        grid = jacobian.grid
        near = _influence_nearby(jacobian)
        self._share = 0.5 if grid.mesh.is_line else 0.25
        self._K00, self._kappa = near[0, 0], influence_of_columns(near, self._share)
        self._bands = LineBands(*grid.shape)
        self._w = np.zeros(grid.shape)
        self._ghosted_w = np.zeros(grid.ghosted_shape)
        self._out = np.zeros(grid.shape)

    @event(LINES)
    def partition(self, status):
        """Choose the distributive nodes of the present linearisation; `status` (lines, nx)."""
        grid, eps = self._jacobian.grid, self._jacobian.linearisation.eps
        self._distributive = grid.halo(distributive_nodes(eps, status, grid.mesh.dX, self._K00))
        self._given = given_nodes(status)

    @event(LINES)
    def setUp(self, _pc):
        """Factor the bands of the present linearisation."""
        bands, linearisation = self._bands, self._jacobian.linearisation
        bands.factor(linearisation, self._distributive[1:-1], self._kappa, self._share)

    @event(LINES)
    def apply(self, _pc, x, y):
        """One relaxation from zero; the border is left alone."""
        space = self._jacobian.space
        r, _ = space.read_own(x)
        self._bands.solve(r, self._w)
        self._jacobian.grid.halo(self._w, out=self._ghosted_w)
        distribute(self._ghosted_w, self._distributive, self._share, self._omega, self._out)
        self._out[self._given] = 0.0
        space.write(y, self._out, 0.0)

    def view(self, _pc, viewer):
        viewer.printfASCII(f"  distributive x-line Jacobi, omega {self._omega}, {REACH} neighbours\n")


class RigidLineSmoother:
    """The same of a rigid gap, y = omega T^-1 x: without K there is nothing to distribute."""

    def __init__(self, jacobian, omega):
        self._jacobian, self._omega = jacobian, omega
        self._bands = LineBands(*jacobian.grid.shape, REACH_OF_STENCIL)
        self._out = np.zeros(jacobian.grid.shape)

    def partition(self, status):
        """Remember where the pressure is given; `status` (lines, nx)."""
        self._given = given_nodes(status)

    @event(LINES)
    def setUp(self, _pc):
        """Factor the lines of the present linearisation."""
        self._bands.factor_stencil(self._jacobian.linearisation.A)

    @event(LINES)
    def apply(self, _pc, x, y):
        """One relaxation from zero; the border is left alone."""
        space = self._jacobian.space
        r, _ = space.read_own(x)
        self._bands.solve(r, self._out)
        self._out *= self._omega
        self._out[self._given] = 0.0
        space.write(y, self._out, 0.0)

    def view(self, _pc, viewer):
        viewer.printfASCII(f"  x-line Jacobi of a rigid gap, omega {self._omega}\n")


def _influence_nearby(jacobian):
    """Influence coefficients of the few nearest nodes, [l, k]."""
    mesh = jacobian.grid.mesh
    return influence_coefficients(mesh, jacobian.contact.kernel, 0, 3)[:, : REACH + 2]
