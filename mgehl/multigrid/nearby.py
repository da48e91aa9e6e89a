"""A direct solve of all that couples nearby nodes.

Peaks shut fluid into valleys, and the pressure of each valley is a soft mode of its own (`memory`). On
coarse grids the valleys leak, and a line of nodes knows nothing of the lines beside it. What decides such a
pressure is nearby: the channels that lead out of the valley, and how its bed gives way. The near part of
J Q on the whole grid is a sparse matrix that has these modes as they are.
"""

import numpy as np
from petsc4py import PETSc

from mgehl.discretization.axes import own
from mgehl.discretization.mesh import HALO
from mgehl.grid.events import NEARBY, event
from mgehl.multigrid.assembled import stencil_rows

NEAR = np.array([(line, node) for line in (-1, 0, 1) for node in (-1, 0, 1)])
"""(lines, nodes) to the nodes whose deflection a correction has in the matrix. With itself alone a ball of
200 nm rms takes 33 iterations of GMRES, with these 22, with two nodes on each side 18 and twice the
time."""

PACKAGES = "mumps", "superlu_dist"
"""Direct solvers on several ranks, the best one first; without them each rank solves the whole."""


class NearbySolve:
    """LU of T, the near part of J Q on all lines; Q as in `kernels.build_bands`.

    `K` holds the influence coefficients of the few nearest nodes [line, node], `share` is what Q hands to
    each neighbour.
    """

    def __init__(self, jacobian, K, share):
        self._jacobian, self._share = jacobian, share
        self._single = np.array([K[abs(line), abs(node)] for line, node in NEAR])
        self._around = np.array([_around(K, abs(line), abs(node)) for line, node in NEAR])
        self._ksp, self._r, self._w = None, None, None

    def free(self):
        """Destroy the PETSc objects."""
        for each in (self._ksp, self._r, self._w):
            if each:
                each.destroy()
        self._ksp, self._r, self._w = None, None, None

    @event(NEARBY)
    def factor(self, distributive, free):
        """Factor T of the present linearisation.

        Masks (lines + 2 HALO, nx): the distributive nodes, and those whose pressure is not given.
        """
        self.free()
        matrix = self.matrix(distributive, free)
        self._r, self._w = matrix.createVecs()
        self._ksp = PETSc.KSP().create(self._jacobian.grid.comm)
        self._ksp.setOptionsPrefix("mgehl_nearby_")
        self._ksp.setType(PETSc.KSP.Type.PREONLY)
        self._ksp.setOperators(matrix)
        _make_direct(self._ksp.getPC())
        self._ksp.setFromOptions()
        self._ksp.setUp()
        matrix.destroy()

    @event(NEARBY)
    def solve(self, r, w):
        """Solve T w = r, both (lines, nx). A singular T gives a `w` that is not finite."""
        self._r.setArray(r.ravel())
        self._ksp.solve(self._r, self._w)
        w[:] = self._w.getArray(readonly=True).reshape(w.shape)

    def matrix(self, distributive, free):
        """T = A Q + B N, N the deflection of near nodes by a column of Q; arguments as of `factor`."""
        lin = self._jacobian.linearisation
        A, B = (self._mat(lin.offsets, stencil) for stencil in (lin.A, lin.B))
        Q, N = (self._mat(NEAR, stencil) for stencil in self._columns(distributive, free))
        T, BN = A.matMult(Q), B.matMult(N)
        T.axpy(1.0, BN, PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN)
        for each in (A, B, Q, N, BN):
            each.destroy()
        return T

    def _columns(self, distributive, free):
        """Stencils of Q and N, each (9, lines, nx): what a node has of the columns of the nodes around it.

        Where the pressure is given a column has no deflection, and what is handed over there is dropped.
        """
        spread = -self._share * _beside(distributive)
        distance = np.abs(NEAR).sum(axis=1)[:, None, None]
        Q = np.where(distance == 1, spread * own(free), 1.0 * (distance == 0))
        N = self._single[:, None, None] + self._around[:, None, None] * spread
        return Q, N * _beside(free)

    def _mat(self, offsets, stencil):
        """The distributed matrix of a stencil (offsets, lines, nx)."""
        grid = self._jacobian.grid
        rows = stencil_rows(offsets, stencil, grid.first * grid.mesh.nx, grid.mesh.nodes)
        size = (rows.shape[0], PETSc.DECIDE)
        csr = rows.indptr.astype(PETSc.IntType), rows.indices.astype(PETSc.IntType), rows.data
        return PETSc.Mat().createAIJ((size, size), csr=csr, comm=grid.comm)

    def view(self, viewer):
        viewer.printfASCII("  LU of what couples nearby nodes\n")


def _around(K, line, node):
    """Influence of a node's four neighbours together."""
    return K[abs(line - 1), node] + K[line + 1, node] + K[line, abs(node - 1)] + K[line, node + 1]


def _beside(ghosted):
    """Of every node and those around it, (9, lines, nx), in the order of `NEAR`; 0 outside the domain."""
    padded = np.pad(ghosted.astype(float), ((0, 0), (1, 1)))
    lines, nx = len(ghosted) - 2 * HALO, ghosted.shape[1]
    return np.stack([padded[HALO + line :][:lines, 1 + node :][:, :nx] for line, node in NEAR])


def _make_direct(pc):
    """Make a PC the best direct solver that PETSc has; its options may change it."""
    packages = [name for name in PACKAGES if PETSc.Sys.hasExternalPackage(name)]
    pc.setType(PETSc.PC.Type.LU if packages else PETSc.PC.Type.REDUNDANT)
    if packages:
        pc.setFactorSolverType(packages[0])
