"""A direct solve of all that couples nearby nodes.

The pressure of a valley that peaks shut in is a soft mode (`memory`) that coarse grids and lines do not
see. What decides it is nearby: channels out of it, and how its bed gives way. The near part of J Q has it.
"""

import numpy as np
from petsc4py import PETSc

from mgehl.discretization.bands import influence_of_neighbours
from mgehl.discretization.residual import shifted
from mgehl.grid.events import NEARBY, event
from mgehl.multigrid.options import OF_NEARBY_NODES, by_default
from mgehl.multigrid.stencil_matrix import StencilMatrix

NEAR = np.array([(line, node) for line in (-1, 0, 1) for node in (-1, 0, 1)])
"""(lines, nodes) to the nodes whose deflection a correction has in the matrix: itself alone takes half more
iterations, two nodes on each side twice the time."""

CENTRE = 4
"""Place of the node itself among them."""

PACKAGES = "mumps", "superlu_dist"
"""Direct solvers on several ranks, the best one first; without them each rank solves the whole."""


class NearbySolve:
    """LU of T = A Q + B N, the near part of J Q, between the nodes of a `zone`, a mask (lines, nx).

    Q as in `band_kernels.build_bands`, N the deflection of near nodes by its columns; `K` and `share` as of
    a `CliffZone`. The order of elimination is found once, for the places of T's entries stay. It must not
    depend on the entries (MUMPS's `icntl_6`): a run that goes on finds it from others.
    """

    def __init__(self, jacobian, K, share, zone):
        self._jacobian, self._columns, self._zone = jacobian, NearColumns(K, share), zone
        self._parts, self._products = [], [None, None]
        self._places = self._within = self._ksp = None
        self._vecs = ()

    def free(self):
        """Destroy the PETSc objects."""
        everything = self._ksp, self._within, self._places, *self._vecs, *self._products, *self._parts
        for each in everything:
            if each:
                each.destroy()

    @event(NEARBY)
    def factor(self, distributive, free):
        """Factor T of the present linearisation. Masks (lines + 2 HALO, nx): the distributive nodes, and
        those whose pressure is not given."""
        matrix = self.matrix(distributive, free)
        if self._places is None:
            numbers = np.flatnonzero(self._zone) + self._jacobian.grid.first * self._zone.shape[1]
            self._places = PETSc.IS().createGeneral(numbers.astype(PETSc.IntType), comm=matrix.comm)
        self._within = matrix.createSubMatrix(self._places, self._places, self._within)
        if self._ksp is None:
            self._ksp = _direct_solver(self._within)
            self._vecs = self._within.createVecs()
        with by_default(OF_NEARBY_NODES, mat_mumps_icntl_6=0):
            self._ksp.setUp()

    @event(NEARBY)
    def solve(self, r, w):
        """Solve T w = r in the zone, both (lines, nx); beyond it w is zero. A singular T gives a `w` that
        is not finite."""
        right, left = self._vecs
        right.setArray(r[self._zone])
        self._ksp.solve(right, left)
        w[:] = 0.0
        w[self._zone] = left.getArray(readonly=True)

    def matrix(self, distributive, free):
        """T of all nodes, which the next call overwrites; arguments as of `factor`."""
        grid, lin = self._jacobian.grid, self._jacobian.linearisation
        if not self._parts:
            places = lin.offsets, lin.offsets, NEAR, NEAR
            self._parts = [StencilMatrix(grid, offsets) for offsets in places]
        stencils = lin.by_unknown, lin.B, *self._columns.stencils(_beside(distributive), _beside(free))
        for part, stencil in zip(self._parts, stencils, strict=True):
            part.set(stencil)
        A, B, Q, N = (part.mat for part in self._parts)
        T, BN = self._products
        T, BN = self._products = A.matMult(Q, result=T), B.matMult(N, result=BN)
        T.axpy(1.0, BN, PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
        return T

    def view(self, viewer):
        viewer.printfASCII("  LU of what couples nearby nodes around the contact\n")


class NearColumns:
    """What a node has of the columns of Q and N that stand at the nodes around it. `K` and `share` as of a
    `NearbySolve`."""

    def __init__(self, K, share):
        places = np.abs(NEAR)
        self._share, self._beside = share, places.sum(axis=1)
        self._single = np.array([K[tuple(at)] for at in places])
        self._around = np.array([influence_of_neighbours(K, *at) for at in places])

    def stencils(self, distributive, free):
        """Of Q and of N, (9, ...), for masks (9, ...) of the nodes around each, in the order of `NEAR`.

        Where the pressure is given, so that a node is not `free`, a column has no deflection, and what is
        handed over there is dropped.
        """
        one_each = (len(NEAR), *[1] * (np.ndim(free) - 1))
        beside, single, around = (
            each.reshape(one_each) for each in (self._beside, self._single, self._around)
        )
        spread, itself = -self._share * distributive, free[CENTRE]
        Q = np.where(beside == 1, spread * itself, 1.0 * (beside == 0))
        return Q, (single + around * spread) * free


def _beside(ghosted):
    """Of every node and those around it, (9, lines, nx), in the order of `NEAR`; 0 outside the domain."""
    return np.stack([shifted(ghosted.astype(float), offset) for offset in NEAR])


def _direct_solver(matrix):
    """A KSP that is the best direct solver that PETSc has for a matrix; options may change it."""
    ksp = PETSc.KSP().create(matrix.comm)
    ksp.setOptionsPrefix(OF_NEARBY_NODES)
    ksp.setType(PETSc.KSP.Type.PREONLY)
    ksp.setOperators(matrix)
    packages = [name for name in PACKAGES if PETSc.Sys.hasExternalPackage(name)]
    ksp.getPC().setType(PETSc.PC.Type.LU if packages else PETSc.PC.Type.REDUNDANT)
    if packages:
        ksp.getPC().setFactorSolverType(packages[0])
    ksp.setFromOptions()
    return ksp
