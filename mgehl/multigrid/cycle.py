"""The V-cycle: PETSc's PCMG as the right preconditioner of flexible GMRES.

Coarse operators are rediscretised with P, H and status injected from the fine grid. The
border travels with the residual, so H0 is corrected by the direct solve on the coarsest grid
and the cycle needs no second solve for its column.
"""

from petsc4py import PETSc

from mgehl.discretization.fluid import fluid_state
from mgehl.multigrid.coarse import CoarseSolve
from mgehl.multigrid.jacobian import Jacobian
from mgehl.multigrid.smoother import LineSmoother
from mgehl.grid.transfers import ResidualTransfer


class _Restriction:
    """Python context of the Mat that restricts bordered residuals."""

    def __init__(self, transfer, fine, coarse):
        self._transfer, self._fine, self._coarse = transfer, fine.space, coarse.space
        self._load_ratio = coarse.load_scale / fine.load_scale

    def mult(self, _mat, x, y):
        """y = R x from the fine to the coarse space."""
        r, load = self._fine.read(x)
        self._coarse.write(y, self._transfer.restrict(r), load * self._load_ratio)


class _Interpolation:
    """Python context of the Mat that interpolates bordered corrections."""

    def __init__(self, transfer, fine, coarse):
        self._transfer, self._fine, self._coarse = transfer, fine.space, coarse.space

    def mult(self, _mat, x, y):
        """y = P x from the coarse to the fine space."""
        correction, dH0 = self._coarse.read(x)
        self._fine.write(y, self._transfer.prolong(correction), dH0)


class MultigridSolver:
    """Flexible GMRES with one V-cycle for the bordered Jacobian of the finest of `grids`.

    `deflections` and `transfers` belong to the same grids, coarsest first; `transfers[l]` leads
    from grid l to grid l + 1.
    """

    def __init__(self, grids, deflections, transfers, contact, scheme, settings):
        self.contact = contact
        self.jacobians = [
            Jacobian(grid, deflection, contact, scheme)
            for grid, deflection in zip(grids, deflections, strict=True)
        ]
        self._transfers = transfers
        self._residual_transfers = [ResidualTransfer(transfer) for transfer in transfers]
        self._smoothers = [LineSmoother(jacobian) for jacobian in self.jacobians[1:]]
        self.ksp = self._create_ksp(grids[-1].comm, settings)

    @property
    def space(self):
        """Space of the finest grid's vectors."""
        return self.jacobians[-1].space

    def linearise(self, P, H, status):
        """Linearise on every grid about the finest grid's (lines, nx) state."""
        coarser = None
        for level in range(len(self.jacobians) - 1, -1, -1):
            jacobian = self.jacobians[level]
            ghosted = [jacobian.grid.halo(array) for array in (P, H, status)]
            jacobian.linearise(*ghosted)
            if level > 0:
                eps = fluid_state(ghosted[0], ghosted[1], self.contact).eps
                self._smoothers[level - 1].partition(eps, ghosted[2])
                transfer = self._transfers[level - 1]
                coarser = [transfer.inject(array) for array in (P, H, status)]
                self._residual_transfers[level - 1].partition(coarser[2], status)
                P, H, status = coarser

    def solve(self, rhs, correction, rtol):
        """Solve J correction = rhs to the relative tolerance; return the iterations."""
        self.ksp.setTolerances(rtol=rtol)
        self.ksp.solve(rhs, correction)
        return self.ksp.getIterationNumber()

    def _create_ksp(self, comm, settings):
        ksp = PETSc.KSP().create(comm)
        ksp.setOptionsPrefix(settings.options_prefix)
        ksp.setType(PETSc.KSP.Type.FGMRES)
        ksp.setOperators(self.jacobians[-1].mat)
        ksp.setTolerances(max_it=settings.max_iterations, atol=0.0)
        self._configure_cycle(ksp.getPC(), settings)
        ksp.setFromOptions()
        return ksp

    def _configure_cycle(self, pc, settings):
        pc.setType(PETSc.PC.Type.MG)
        pc.setMGLevels(len(self.jacobians))
        pc.setMGType(PETSc.PC.MGType.MULTIPLICATIVE)
        for level, jacobian in enumerate(self.jacobians):
            if level == 0:
                solver, context, sweeps = pc.getMGCoarseSolve(), CoarseSolve(jacobian), 1
                solver.setType(PETSc.KSP.Type.PREONLY)
            else:
                solver, context, sweeps = pc.getMGSmoother(level), self._smoothers[level - 1], settings.sweeps
                solver.setType(PETSc.KSP.Type.RICHARDSON)
                pc.setMGRestriction(level, self._transfer_mat(level, _Restriction, down=True))
                pc.setMGInterpolation(level, self._transfer_mat(level, _Interpolation, down=False))
            solver.setNormType(PETSc.KSP.NormType.NONE)
            solver.setTolerances(max_it=sweeps)
            solver.setOperators(jacobian.mat)
            solver.getPC().setType(PETSc.PC.Type.PYTHON)
            solver.getPC().setPythonContext(context)

    def _transfer_mat(self, level, kind, down):
        fine, coarse = self.jacobians[level], self.jacobians[level - 1]
        context = kind(self._residual_transfers[level - 1], fine, coarse)
        spaces = (coarse.space, fine.space) if down else (fine.space, coarse.space)
        sizes = [(space.local_size, PETSc.DECIDE) for space in spaces]
        mat = PETSc.Mat().createPython(sizes, context, comm=fine.grid.comm)
        mat.setUp()
        return mat
