"""Damped Jacobi line relaxation, distributive where the Poiseuille flow is weak."""

from math import inf

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
from mgehl.multigrid.nearby import NearbySolve

PATIENCE = 30
"""Relaxations of one linear system by lines; then nearby nodes are solved at once. To factor them takes as
long as some fifteen iterations."""

MOST_AT_ONCE = 50
"""Relaxations of one linear system with nearby nodes at once; then it is finished by lines, and so are all
later ones. Of 60 contacts of machines on 257 nodes (`mgehl.studies.machine`) two took more than 16, both of
soft polymer, 39 and 70. The second takes 37 s for 105 by this, with 30 it takes 55; a dented one on 513
nodes 128 s for some 500."""

LARGEST = 600_000
"""Most nodes of a grid whose nearby nodes are solved at once: 4 to 9 kB for each."""

BY_LINES, AT_ONCE, BY_LINES_AGAIN = "by lines", "nearby nodes at once", "by lines again"
"""Ways of a `ValleySmoother`."""


class LineSmoother:
    """Relaxation c = omega Q T^-1 r, T the x-lines' part of J Q.

    Without the distribution Q the relaxation diverges: K is long-ranged, and a band of it
    overshoots on smooth corrections; K Q decays fast enough for a band.
    """

    relaxations = 1
    """Of one sweep."""
    sees_cliffs = False
    """Whether it relaxes what stands at cliffs of the mobility as well as the rest."""
    hands_over_everywhere = True
    """Whether every node takes what the lines beside it hand over, driven or not."""
    way = ""
    """Which of several ways it takes; there is but one."""

    def __init__(self, jacobian, omega):
        self._jacobian, self._omega = jacobian, omega
        grid = jacobian.grid
        self._near = influence_nearby(jacobian)
        self._share = 0.5 if grid.mesh.is_line else 0.25
        self._K00, self._kappa = self._near[0, 0], influence_of_columns(self._near, self._share)
        self._bands = LineBands(*grid.shape, before=grid.first)
        self._w = np.zeros(grid.shape)
        self._ghosted_w = np.zeros(grid.ghosted_shape)

    def free(self):
        """Free what PETSc does not free."""

    @event(LINES)
    def partition(self, rows):
        """Choose the distributive nodes of the present linearisation; `rows` (lines, nx)."""
        grid, eps = self._jacobian.grid, self._jacobian.linearisation.eps
        self._distributive = grid.halo(distributive_nodes(eps, rows, grid.mesh.dX, self._K00))

    def forget(self):
        """Free the memory of the factors."""
        self._bands.forget()

    @event(LINES)
    def factor(self):
        """Factor the bands of the present linearisation."""
        self._factor_x_lines()

    def factor_alone(self):
        """Factor what one rank factors for all: of lines nothing."""

    def _factor_x_lines(self):
        """Factor the bands of the x-lines; return their diagonal before that, (lines, nx)."""
        nodes = own(self._distributive), self._jacobian.given
        return self._bands.factor(self._jacobian.linearisation, *nodes, self._kappa, self._share)

    @event(LINES)
    def relax(self, r):
        """Correction for the residual `r`, both (lines, nx); the next call overwrites it."""
        self._solve_lines(r)
        return self._distributed(self._omega, self.hands_over_everywhere)

    def _distributed(self, omega, everywhere):
        """The correction omega Q w in the place of w; `everywhere` as of `kernels.distribute`."""
        self._jacobian.grid.halo(self._w, out=self._ghosted_w)
        distribute(self._ghosted_w, self._distributive, self._share, omega, self._w, everywhere)
        self._w[self._jacobian.given] = 0.0
        return self._w

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
    solved after 110. Grids of more than `LARGEST` nodes keep the lines, and where a system takes more than
    `MOST_AT_ONCE` relaxations all later ones are left to the lines again: in soft bodies what a valley
    couples to is not near.
    """

    def __init__(self, jacobian, omega):
        super().__init__(jacobian, omega)
        self._nearby = NearbySolve(jacobian, self._near, self._share)
        self.way, self._taken = BY_LINES, 0  # the present way, and relaxations of this system by it

    def free(self):
        """Free the PETSc objects."""
        self._nearby.free()

    def partition(self, rows):
        """As of a `LineSmoother`."""
        super().partition(rows)
        self._movable = self._jacobian.grid.halo(rows != PRESSURE)

    def factor(self):
        """Factor what the next relaxation needs."""
        self._taken = 0
        if self.way == AT_ONCE:
            self._nearby.factor(self._distributive, self._movable)
        else:
            super().factor()

    def relax(self, r):
        """As of a `LineSmoother`."""
        if self._taken == self._most:
            if self.way == AT_ONCE:
                self._nearby.free()  # for good
            self.way = AT_ONCE if self.way == BY_LINES else BY_LINES_AGAIN
            self.factor()
        self._taken += 1
        if self.way != AT_ONCE:
            return super().relax(r)
        self._nearby.solve(r, self._w)
        return self._distributed(1.0, everywhere=True)

    @property
    def _most(self):
        """Relaxations of a system after which another way is taken."""
        if self.way == AT_ONCE:
            return MOST_AT_ONCE
        has_another = self.way == BY_LINES and self._jacobian.grid.mesh.nodes <= LARGEST
        return PATIENCE if has_another else inf

    def view(self, viewer):
        super().view(viewer)
        if self.way == AT_ONCE:
            self._nearby.view(viewer)


class RigidLineSmoother:
    """The same of a rigid gap, c = omega T^-1 r: without K there is nothing to distribute."""

    relaxations = 2
    sees_cliffs = False
    way = ""

    def __init__(self, jacobian, omega):
        self._jacobian, self._omega, grid = jacobian, omega, jacobian.grid
        self._bands = LineBands(*grid.shape, REACH_OF_STENCIL, grid.first)
        self._out = np.zeros(grid.shape)

    def free(self):
        """Nothing is held that PETSc does not free."""

    def partition(self, _rows):
        """Nothing depends on the kinds of rows."""

    def forget(self):
        """Free the memory of the factors."""
        self._bands.forget()

    @event(LINES)
    def factor(self):
        """Factor the lines of the present linearisation."""
        self._bands.factor_stencil(self._jacobian.linearisation, self._jacobian.given)

    def factor_alone(self):
        """Of lines one rank factors nothing for all."""

    @event(LINES)
    def relax(self, r):
        """Correction for the residual `r`, both (lines, nx); the next call overwrites it."""
        self._bands.solve(r, self._out)
        self._out *= self._omega
        self._out[self._jacobian.given] = 0.0
        return self._out

    def view(self, viewer):
        viewer.printfASCII(f"  x-line Jacobi of a rigid gap, omega {self._omega}\n")


def influence_nearby(jacobian, turned=False):
    """Influence coefficients of the few nearest nodes: lines beside by nodes along, `turned` of y-lines."""
    mesh, kernel = jacobian.grid.mesh, jacobian.contact.kernel
    beside, along = LINES_BESIDE + 2, REACH + 2
    if turned:
        return np.ascontiguousarray(influence_coefficients(mesh, kernel, 0, along)[:, :beside].T)
    return influence_coefficients(mesh, kernel, 0, beside)[:, :along]
