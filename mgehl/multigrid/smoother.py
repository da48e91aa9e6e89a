"""Damped Jacobi line relaxation, distributive where the Poiseuille flow is weak."""

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.band_kernels import REACH
from mgehl.discretization.bands import (
    LINES_BESIDE,
    REACH_OF_STENCIL,
    LineBands,
    distributive_nodes,
    influence_of_columns,
)
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.kernels import distribute
from mgehl.discretization.rows import PRESSURE
from mgehl.grid.events import LINES, event
from mgehl.grid.transpose import YLines
from mgehl.multigrid.nearby import NearbySolve

PATIENCE = 30
"""Relaxations of one linear system by lines; then nearby nodes are solved at once. To factor them takes as
long as some fifteen iterations."""

LARGEST = 600_000
"""Most nodes of a grid whose nearby nodes are solved at once: some 2.5 kB for each."""


class LineSmoother:
    """Relaxation c = omega Q T^-1 r, T the x-lines' part of J Q.

    Without the distribution Q the relaxation diverges: K is long-ranged, and a band of it
    overshoots on smooth corrections; K Q decays fast enough for a band.
    """

    visits = 1
    """Relaxations that one sweep takes."""
    hands_over_everywhere = True
    """Whether every node takes what the lines beside it hand over, driven or not."""

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
        """Free what PETSc does not free."""

    @event(LINES)
    def partition(self, rows):
        """Choose the distributive nodes of the present linearisation; `rows` (lines, nx)."""
        grid, eps = self._jacobian.grid, self._jacobian.linearisation.eps
        self._distributive = grid.halo(distributive_nodes(eps, rows, grid.mesh.dX, self._K00))
        self._given = rows == PRESSURE

    @event(LINES)
    def factor(self):
        """Factor the bands of the present linearisation."""
        distributive = own(self._distributive)
        self._bands.build(self._jacobian.linearisation, distributive, self._kappa, self._share)
        self._bands.factor()

    @event(LINES)
    def relax(self, r):
        """Correction for the residual `r`, both (lines, nx); the next call overwrites it."""
        self._solve_lines(r)
        return self._distributed(self._omega, self.hands_over_everywhere)

    def _distributed(self, omega, everywhere):
        """The correction omega Q w; `everywhere` as of `kernels.distribute`."""
        self._jacobian.grid.halo(self._w, out=self._ghosted_w)
        distribute(self._ghosted_w, self._distributive, self._share, omega, self._out, everywhere)
        self._out[self._given] = 0.0
        return self._out

    def _solve_lines(self, r):
        """Solve the lines for the residual `r`, into `_w`."""
        self._bands.solve(r, self._w)

    def view(self, viewer):
        viewer.printfASCII(f"  distributive x-line Jacobi, omega {self._omega}, {REACH} neighbours\n")


class RoughLineSmoother(LineSmoother):
    """The same where film and contact change from node to node, as on rough surfaces.

    A stiff node hands nothing over to a pressure-driven node of the line beside it. That would leave a
    residual there as large as the node's mobility, which lines solved apart from each other could not
    remove (a ball of 400 nm rms at 1 mm/s: 17 iterations for 39).
    """

    hands_over_everywhere = False


class ValleySmoother(RoughLineSmoother):
    """The same until a linear system has taken `PATIENCE` relaxations; from then on a `NearbySolve`, c = Q
    T^-1 r: in the rest of that system and in all later ones.

    A ball of 200 nm rms at 3.5 um/s on 257 nodes takes 22 iterations of GMRES; by lines alone it was not
    solved after 110. Grids of more than `LARGEST` nodes keep the lines.
    """

    def __init__(self, jacobian, omega):
        super().__init__(jacobian, omega)
        self._nearby = NearbySolve(jacobian, _influence_nearby(jacobian), self._share)
        self._left = PATIENCE
        self.at_once = False
        """Whether nearby nodes are solved at once."""

    def free(self):
        """Free the PETSc objects."""
        self._nearby.free()

    def partition(self, rows):
        """As of a `LineSmoother`."""
        super().partition(rows)
        self._movable = self._jacobian.grid.halo(rows != PRESSURE)

    def factor(self):
        """Factor what the next relaxation needs."""
        self._left = PATIENCE
        if self.at_once:
            self._nearby.factor(self._distributive, self._movable)
        else:
            super().factor()

    def relax(self, r):
        """As of a `LineSmoother`."""
        if not self.at_once:
            if self._left > 0 or self._jacobian.grid.mesh.nodes > LARGEST:
                self._left -= 1
                return super().relax(r)
            self.at_once = True
            self.factor()
        self._nearby.solve(r, self._w)
        return self._distributed(1.0, everywhere=True)

    def view(self, viewer):
        super().view(viewer)
        if self.at_once:
            self._nearby.view(viewer)


class CrossedLineSmoother(LineSmoother):
    """The same with lines along both axes: c = omega Q (X D^-1 Y)^-1 r.

    X and Y are the parts of J Q along the x-lines and along the y-lines, D their diagonal: the product is J
    Q but for what couples both. Lines along one axis alone leave waves across the motion, the more the
    finer the grid; the product damps these, too (M = 20, L = 10 by 2B on 257 nodes: 3 iterations of GMRES
    at the most for 6). A relaxation goes along X first and then along Y, the next one the other way round.
    """

    def __init__(self, jacobian, omega):
        super().__init__(jacobian, omega)
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

    @event(LINES)
    def factor(self):
        """Factor the bands of the present linearisation; the next relaxation begins along X."""
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
        """Solve along one axis, then along the other; the next time in the other order."""
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

    def view(self, viewer):
        words = f"omega {self._omega}, {REACH} neighbours"
        viewer.printfASCII(f"  distributive Jacobi along x- and y-lines, {words}\n")


class RigidLineSmoother:
    """The same of a rigid gap, c = omega T^-1 r: without K there is nothing to distribute."""

    visits = 2

    def __init__(self, jacobian, omega):
        self._jacobian, self._omega = jacobian, omega
        self._bands = LineBands(*jacobian.grid.shape, REACH_OF_STENCIL)
        self._out = np.zeros(jacobian.grid.shape)

    def free(self):
        """Nothing is held that PETSc does not free."""

    def partition(self, rows):
        """Remember where the pressure is given; `rows` (lines, nx)."""
        self._given = rows == PRESSURE

    @event(LINES)
    def factor(self):
        """Factor the lines of the present linearisation."""
        self._bands.factor_stencil(self._jacobian.linearisation)

    @event(LINES)
    def relax(self, r):
        """Correction for the residual `r`, both (lines, nx); the next call overwrites it."""
        self._bands.solve(r, self._out)
        self._out *= self._omega
        self._out[self._given] = 0.0
        return self._out

    def view(self, viewer):
        viewer.printfASCII(f"  x-line Jacobi of a rigid gap, omega {self._omega}\n")


def smoother_of(jacobian, rough=False, finest=False, apart=False):
    """The class of a grid's smoother: a rigid gap has no K, and a single line has nothing beside it.

    Where the fluid is solved `apart` hardly more than contact is left, which has no direction: lines along
    X take as many convolutions there, and a tenth less time.
    """
    if jacobian.rigid:
        return RigidLineSmoother
    if rough:
        return ValleySmoother if finest and not jacobian.grid.mesh.is_line else RoughLineSmoother
    return LineSmoother if apart or jacobian.grid.mesh.is_line else CrossedLineSmoother


def _influence_nearby(jacobian, turned=False):
    """Influence coefficients of the few nearest nodes: lines beside by nodes along, `turned` of y-lines."""
    mesh, kernel = jacobian.grid.mesh, jacobian.contact.kernel
    beside, along = LINES_BESIDE + 2, REACH + 2
    if turned:
        return np.ascontiguousarray(influence_coefficients(mesh, kernel, 0, along)[:, :beside].T)
    return influence_coefficients(mesh, kernel, 0, beside)[:, :along]
