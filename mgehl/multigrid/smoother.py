"""Damped Jacobi line relaxation, distributive where the Poiseuille flow is weak."""

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.band_kernels import REACH
from mgehl.discretization.bands import LINES_BESIDE, LineBands, distributive_nodes, influence_of_columns
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.kernels import distribute
from mgehl.grid.events import LINES, event


class LineSmoother:
    """Relaxation c = omega Q T^-1 r, T the x-lines' part of J Q. Without Q it diverges: K is long-ranged,
    and a band of it overshoots on smooth corrections; K Q decays fast enough."""

    words = "lines along x"
    """Of a recipe."""
    sees_cliffs = False
    """Whether it relaxes what stands at cliffs of the mobility as well as the rest."""
    way = ""
    """Which of several ways it takes; there is but one."""

    def __init__(self, jacobian, omega):
        self._jacobian, self._omega, grid = jacobian, omega, jacobian.grid
        self._bands = LineBands(*grid.shape, grid.first)
        self._near = influence_nearby(jacobian)
        self._share = 0.5 if grid.mesh.is_line else 0.25
        self._K00, self._kappa = self._near[0, 0], influence_of_columns(self._near, self._share)
        self._w, self._ghosted_w = np.zeros(grid.shape), np.zeros(grid.ghosted_shape)

    def free(self):
        """Free what PETSc does not free."""

    def forget(self):
        """Free the memory of the factors."""
        self._bands.forget()

    def factor_alone(self):
        """Factor what one rank factors for all: of lines nothing."""

    @event(LINES)
    def partition(self, rows):
        """Choose the distributive nodes."""
        grid, eps = self._jacobian.grid, self._jacobian.linearisation.eps
        mesh = grid.mesh
        self._distributive = grid.halo(distributive_nodes(eps, rows, mesh.dX, self._K00, mesh.is_line))

    @event(LINES)
    def factor(self):
        """Factor the bands of the present linearisation."""
        self._factor_x_lines()

    def _factor_x_lines(self):
        """Factor the bands of the x-lines; return their diagonal before that, (lines, nx)."""
        jacobian = self._jacobian
        nodes = own(self._distributive), jacobian.given
        return self._bands.factor(
            jacobian.linearisation, *nodes, self._kappa, self._share, jacobian.contents
        )

    @event(LINES)
    def relax(self, r):
        """Correction for the residual `r`, both (lines, nx); the next call overwrites it."""
        self._solve_lines(r)
        return self._distributed(self._omega)

    def _solve_lines(self, r):
        """Solve the lines for the residual `r`, into `_w`."""
        self._bands.solve(r, self._w)

    def _distributed(self, omega, along_x=True, along_y=True):
        """The correction omega Q w in the place of w; what is handed over as of `kernels.distribute`."""
        jacobian = self._jacobian
        jacobian.grid.halo(self._w, out=self._ghosted_w)
        distribute(self._ghosted_w, self._distributive, self._share, omega, self._w, along_x, along_y)
        self._w[jacobian.given] = 0.0
        if jacobian.contents is not None:
            of_contents = own(self._ghosted_w)[jacobian.contents]
            self._w[jacobian.contents] = omega * of_contents if along_x else 0.0
        return self._w

    def view(self, viewer):
        viewer.printfASCII(f"  distributive x-line Jacobi, omega {self._omega}, {REACH} neighbours\n")


def influence_nearby(jacobian, turned=False):
    """Influence coefficients of the few nearest nodes: lines beside by nodes along, `turned` of y-lines."""
    mesh, kernel = jacobian.grid.mesh, jacobian.contact.kernel
    beside, along = LINES_BESIDE + 2, REACH + 2
    if turned:
        return np.ascontiguousarray(influence_coefficients(mesh, kernel, 0, along)[:, :beside].T)
    return influence_coefficients(mesh, kernel, 0, beside)[:, :along]
