"""Damped Jacobi line relaxation, distributive where the Poiseuille flow is weak."""

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.bands import (
    LINES_BESIDE,
    REACH_OF_STENCIL,
    LineBands,
    distributive_nodes,
    influence_of_columns,
)
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.kernels import REACH, distribute
from mgehl.discretization.rows import PRESSURE
from mgehl.grid.events import LINES, event
from mgehl.grid.transpose import YLines


class LineSmoother:
    """Python context of a PC: y = omega Q T^-1 x, T the x-lines' part of J Q.

    Without the distribution Q the relaxation diverges: K is long-ranged, and a band of it
    overshoots on smooth corrections; K Q decays fast enough for a band.
    """

    visits = 1
    """Relaxations that one sweep takes."""

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

    def free(self):
        """Free what PETSc does not know of."""

    @event(LINES)
    def partition(self, rows):
        """Choose the distributive nodes of the present linearisation; `rows` (lines, nx)."""
        grid, eps = self._jacobian.grid, self._jacobian.linearisation.eps
        self._distributive = grid.halo(distributive_nodes(eps, rows, grid.mesh.dX, self._K00))
        self._given = rows == PRESSURE

    @event(LINES)
    def setUp(self, _pc):
        """Factor the bands of the present linearisation."""
        self._factor()

    def _factor(self):
        distributive = own(self._distributive)
        self._bands.build(self._jacobian.linearisation, distributive, self._kappa, self._share)
        self._bands.factor()

    @event(LINES)
    def apply(self, _pc, x, y):
        """One relaxation from zero; the border is left alone."""
        space = self._jacobian.space
        self._solve_lines(space.read_pressure(x))
        self._jacobian.grid.halo(self._w, out=self._ghosted_w)
        distribute(self._ghosted_w, self._distributive, self._share, self._omega, self._out)
        self._out[self._given] = 0.0
        space.write(y, self._out, 0.0)

    def _solve_lines(self, r):
        """Write to `_w` what the lines answer to the residual `r`."""
        self._bands.solve(r, self._w)

    def view(self, _pc, viewer):
        viewer.printfASCII(f"  distributive x-line Jacobi, omega {self._omega}, {REACH} neighbours\n")


class CrossedLineSmoother(LineSmoother):
    """The same for surfaces that move at an angle: y = (1 + omega)/2 Q (X D^-1 Y)^-1 x.

    X and Y are the parts of J Q along the x-lines and along the y-lines, D their diagonal: the product
    is J Q but for what couples both. Lines of one kind alone leave waves across the motion; this damps
    them, too, and wants half the damping (2B on 513 nodes at 15 and 30 degrees: 198 and 218 convolutions
    with 0.9, 187 and 268 with 0.8, 248 and 296 with 1). A sweep goes along X first and then along Y, and
    once more the other way round.
    """

    visits = 2

    def __init__(self, jacobian, omega):
        super().__init__(jacobian, 0.5 * (1.0 + omega))
        grid = jacobian.grid
        self._y_kappa = influence_of_columns(_influence_nearby(jacobian, turned=True), self._share)
        self._y_lines = YLines(grid) if grid.has_lines else None
        if self._y_lines:
            self._y_bands = LineBands(*self._y_lines.shape)
            self._y_w = np.zeros(self._y_lines.shape)

    def free(self):
        """Free the MPI datatypes."""
        if self._y_lines:
            self._y_lines.destroy()

    def _factor(self):
        self._along_y_first = False
        if not self._y_lines:
            return
        distributive, turn = own(self._distributive), self._y_lines.turned
        self._bands.build(self._jacobian.linearisation, distributive, self._kappa, self._share)
        self._diagonal = self._bands.diagonal.copy()
        self._bands.factor()
        turned = self._jacobian.linearisation.turned(turn)
        self._y_bands.build(turned, turn(distributive) > 0.0, self._y_kappa, self._share)
        self._y_bands.factor()

    def _solve_lines(self, r):
        """First along one axis, then along the other; the next time the other way round."""
        if not self._y_lines:
            return
        if self._along_y_first:
            self._solve_y_lines(r)
            self._bands.solve(self._diagonal * self._w, self._w)
        else:
            self._bands.solve(r, self._w)
            self._solve_y_lines(self._diagonal * self._w)
        self._along_y_first = not self._along_y_first

    def _solve_y_lines(self, r):
        self._y_bands.solve(self._y_lines.turned(r), self._y_w)
        self._y_lines.turn_back(self._y_w, self._w)

    def view(self, _pc, viewer):
        words = f"omega {self._omega}, {REACH} neighbours"
        viewer.printfASCII(f"  distributive Jacobi along x- and y-lines, {words}\n")


class RigidLineSmoother:
    """The same of a rigid gap, y = omega T^-1 x: without K there is nothing to distribute."""

    visits = 1

    def __init__(self, jacobian, omega):
        self._jacobian, self._omega = jacobian, omega
        self._bands = LineBands(*jacobian.grid.shape, REACH_OF_STENCIL)
        self._out = np.zeros(jacobian.grid.shape)

    def free(self):
        """Nothing is held that PETSc does not know of."""

    def partition(self, rows):
        """Remember where the pressure is given; `rows` (lines, nx)."""
        self._given = rows == PRESSURE

    @event(LINES)
    def setUp(self, _pc):
        """Factor the lines of the present linearisation."""
        self._bands.factor_stencil(self._jacobian.linearisation)

    @event(LINES)
    def apply(self, _pc, x, y):
        """One relaxation from zero; the border is left alone."""
        space = self._jacobian.space
        r = space.read_pressure(x)
        self._bands.solve(r, self._out)
        self._out *= self._omega
        self._out[self._given] = 0.0
        space.write(y, self._out, 0.0)

    def view(self, _pc, viewer):
        viewer.printfASCII(f"  x-line Jacobi of a rigid gap, omega {self._omega}\n")


def _influence_nearby(jacobian, turned=False):
    """Influence coefficients of the few nearest nodes: lines beside by nodes along, `turned` of y-lines."""
    mesh, kernel = jacobian.grid.mesh, jacobian.contact.kernel
    beside, along = LINES_BESIDE + 2, REACH + 2
    if turned:
        return np.ascontiguousarray(influence_coefficients(mesh, kernel, 0, along)[:, :beside].T)
    return influence_coefficients(mesh, kernel, 0, beside)[:, :along]
