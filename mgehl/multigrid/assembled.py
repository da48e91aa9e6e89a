"""The Jacobian of a rigid gap as an assembled matrix, for PETSc's algebraic multigrid.

Without deflection the Jacobian is a stencil, and an algebraic multigrid beats the geometric one of
the line smoother (a wedge of 1025 by 1025 nodes: 7 iterations instead of 30, in a third of the time).
"""

import numpy as np
from petsc4py import PETSc

from mgehl.discretization.residual import linearise
from mgehl.grid.events import ASSEMBLY, event
from mgehl.multigrid.cycle import MOST_ITERATIONS
from mgehl.multigrid.jacobian import BorderedSpace
from mgehl.multigrid.stencil_matrix import stencil_rows


class AssembledSolver:
    """GMRES with algebraic multigrid for the fluid in a rigid gap.
    BoomerAMG where PETSc has hypre, else PETSc's own GAMG; PETSc options may change it."""

    def __init__(self, grid):
        self.space = BorderedSpace(grid)
        self._grid = grid
        self._ksp, self._mat = None, None

    def free(self):
        """Destroy the matrix; the KSP that uses it must be destroyed before."""
        if self._mat:
            self._mat.destroy()

    def configure(self, ksp, rtol):
        """Make a KSP this solver; its options may still change it."""
        self._ksp = ksp
        ksp.setType(PETSc.KSP.Type.GMRES)
        ksp.setPCSide(PETSc.PC.Side.RIGHT)
        ksp.setTolerances(rtol=rtol, atol=0.0, max_it=MOST_ITERATIONS)
        hypre = PETSc.Sys.hasExternalPackage("hypre")
        ksp.getPC().setType(PETSc.PC.Type.HYPRE if hypre else PETSc.PC.Type.GAMG)
        ksp.setFromOptions()

    @event(ASSEMBLY)
    def linearise(self, evaluation, rows):
        """Linearise about an evaluated state with these kinds of `rows`, and assemble."""
        linearisation = linearise(evaluation, rows)
        self.free()
        self._mat = self._assemble(linearisation)
        self._ksp.setOperators(self._mat)

    def _assemble(self, linearisation):
        """The distributed matrix; the border's row is that of the identity."""
        grid, nodes = self._grid, self._grid.mesh.nodes
        first_row = grid.first * grid.mesh.nx
        rows = stencil_rows(linearisation.offsets, linearisation.by_unknown, first_row, nodes + 1)
        size = (self.space.local_size, PETSc.DECIDE)
        indptr, indices, values = rows.indptr, rows.indices, rows.data
        if self.space.local_size > rows.shape[0]:
            indptr = np.append(indptr, indptr[-1] + 1)
            indices, values = np.append(indices, nodes), np.append(values, 1.0)
        csr = indptr.astype(PETSc.IntType), indices.astype(PETSc.IntType), values
        return PETSc.Mat().createAIJ((size, size), csr=csr, comm=grid.comm)
