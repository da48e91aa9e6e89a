"""The linear solver: an F-cycle as the right preconditioner of flexible GMRES.

Coarse operators are rediscretised with P, H and status injected, and with the arithmetic mean of the
mobility: one that vanishes with either side would close faces that are open on the fine grid. Where the
surfaces move at an angle to the lines, coarse Couette flows have the finest grid's truncation error, for
they would carry waves across the motion along differently.

On rough surfaces GMRES remembers (`memory`). Where the film is thin besides, the mobility at one node says
nothing of those around: it is averaged from grid to grid and held fixed. Rough lines are solved directly,
and in time short ones.
"""

from dataclasses import dataclass, replace

import numpy as np
from petsc4py import PETSc

from mgehl.config_sections import SolverSection
from mgehl.discretization.axes import own
from mgehl.discretization.evaluation import Evaluation
from mgehl.discretization.rows import FLOW, PRESSURE
from mgehl.discretization.status import CAVITATED
from mgehl.grid.freed_memory import is_large
from mgehl.grid.transfers import PartitionedTransfer
from mgehl.multigrid.coarse import CoarseSolve
from mgehl.multigrid.fcycle import FCycle
from mgehl.multigrid.film_ends import end_halfway
from mgehl.multigrid.jacobian import Jacobian
from mgehl.multigrid.memory import Memory
from mgehl.multigrid.options import by_default
from mgehl.multigrid.smoother_choice import smoother_of

DIRECT = 4097
"""Most nodes of a line between rough bodies that is solved directly: coarse grids do not see the peaks
through which valleys are coupled, and a third of such contacts are not found by the cycle."""

DIRECT_IN_TIME = 1025
"""The same of any line in time, where a step takes 3 convolutions then, for 7 to 10. Longer lines take
longer so."""

MOST_ITERATIONS = 100
"""Of GMRES, which is not restarted: thin films on coarse grids take 100, restarted after 30 no end."""

RESTART_OF_LARGE = 6
"""Iterations after which GMRES is restarted on a large grid: it keeps two vectors for each, and PETSc
allocates ten at a time (4097 nodes a side: 2.4 GiB from the fourth iteration on)."""


@dataclass(frozen=True)
class CycleSettings:
    """The linear solver: what its cycle is made of."""

    sweeps: int = SolverSection.sweeps
    """Line relaxations after the coarse grids: each but the first takes a convolution on every grid."""
    omega: float = SolverSection.omega
    """Damping of the line relaxation: with 0.7 and 0.9 up to a third more work."""
    direct: int = 0
    """Most nodes of a line that is solved directly."""
    rough: bool = False
    """Whether peaks are as small as coarse cells: corrections are remembered."""
    in_valleys: bool = False
    """Whether the film is thin besides: its own smoother, coarse mobilities and ends of coarse films."""


class MultigridSolver:
    """Flexible GMRES with one F-cycle for the bordered Jacobian of grid `level`."""

    def __init__(self, hierarchy, level, contact, scheme, settings=CycleSettings()):
        self._hierarchy, self._oblique = hierarchy, scheme.is_oblique
        self._rough, self._in_valleys, self._direct = settings.rough, settings.in_valleys, settings.direct
        self._scheme = scheme
        first = self._first_grid(hierarchy.grids, level)

        def jacobian_on(number, scheme):
            return Jacobian(hierarchy.grids[number], hierarchy.deflections[number], contact, scheme)

        self.jacobians = [
            jacobian_on(number, self._scheme_of(level - number)) for number in range(first, level + 1)
        ]
        """Of the cycle's grids, coarsest first."""
        self.jacobian = self.jacobians[-1]
        """What is solved."""
        self._transfers = hierarchy.transfers[first:level]
        self._partitioned = [PartitionedTransfer(transfer) for transfer in self._transfers]
        self._smoothers = [self._smoother(each)(each, settings.omega) for each in self.jacobians[1:]]
        self._coarse = CoarseSolve(self.jacobians[0])
        cycle = FCycle(self.jacobians, self._partitioned, self._smoothers, self._coarse, settings.sweeps)
        self.memory = Memory(self.jacobian, cycle) if self._rough and self._smoothers else None
        """Of the systems solved so far, where there is one."""
        self._preconditioner = self.memory or cycle

    def _first_grid(self, grids, level):
        """The coarsest grid of the cycle: of lines the finest one that may be solved directly."""
        if not grids[level].mesh.is_line:
            return 0
        most = self._direct
        return max(number for number in range(level + 1) if number == 0 or grids[number].mesh.nx <= most)

    def _scheme_of(self, coarsenings):
        """The scheme of the cycle's operator on a grid so many times coarser than the finest."""
        if coarsenings == 0:
            return self._scheme
        coarse = replace(self._scheme, face_mobility="arithmetic")
        return replace(coarse, coarsenings=coarsenings) if self._oblique else coarse

    def _smoother(self, jacobian):
        """The class of the smoother of a grid."""
        of_grid = jacobian.grid.mesh.is_line, self._scheme.couette, jacobian.holds_film
        return smoother_of(*of_grid, self._in_valleys, jacobian is self.jacobian)

    def free(self):
        """Destroy Mats and MPI datatypes; the KSP that uses them must be destroyed before."""
        for smoother in self._smoothers:
            smoother.free()
        for jacobian in self.jacobians:
            jacobian.mat.destroy()
            # It refers to the jacobian, whose arrays would wait for the garbage collector.
            jacobian.witness = None

    @property
    def work(self):
        """Convolutions of all solves on these grids so far, in those of the finest (collective)."""
        comm = self.jacobian.grid.comm
        return comm.bcast(self._hierarchy.convolutions, root=comm.size - 1)

    @property
    def way(self):
        """How the finest grid's next linear system begins (of a `ValleySmoother`), or ""."""
        return self._smoothers[-1].way if self._smoothers else ""

    @way.setter
    def way(self, way):
        if way:
            self._smoothers[-1].way = way

    @property
    def space(self):
        """Space of the finest grid's vectors."""
        return self.jacobian.space

    def linearise(self, evaluation, rows, rate=0.0, resistance=0.0):
        """Linearise on every grid about the finest grid's evaluated state, with its kinds of `rows`.

        `rate` is 1/time step of an implicit step, or one for each node, (lines, nx); zero for the steady
        equations. The load answers to H0 by itself with a `resistance`. The evaluation forgets its faces
        and, where memory is short, the fluid.
        """
        for jacobian in self.jacobians:
            jacobian.resistance = resistance
        leaks = not self._scheme.contact_law.closes_faces
        self.jacobian.linearise(evaluation, rows, rate, leaks)
        evaluation.forget()
        here = _About.finest(evaluation, rows, rate)
        for level in range(len(self.jacobians) - 2, -1, -1):
            finer, here = here, here.on_coarser(self._transfers[level], averages=self._in_valleys)
            self._linearise_coarse(level, evaluation.contact, here, finer)
        self._coarse.gather()
        if self._memory_is_short:
            evaluation.forget_fluid()

    def _linearise_coarse(self, level, contact, here, finer):
        """Grid `level` about `here`, an `_About`; smoother and transfer of the grid above about `finer`."""
        transfer, jacobian = self._transfers[level], self.jacobians[level]
        found = _evaluate(jacobian, contact, here)
        if self._in_valleys:
            found = found.with_mobility(jacobian.grid.halo(here.eps))
        jacobian.linearise(found, here.rows, here.rate)
        if not self._in_valleys:
            end_halfway(jacobian.linearisation, here.rows, transfer, finer.rows, finer.status)
        self._smoothers[level].partition(finer.rows)
        self._partitioned[level].partition((here.status, here.rows), (finer.status, finer.rows))

    def forget(self):
        """Where memory is short, free that of the linearisation and its factors: the next has others."""
        if self._memory_is_short:
            for part in (*self.jacobians, *self._smoothers):
                part.forget()

    def configure(self, ksp, rtol):
        """Make a KSP (of a SNES, say) this solver; its options may still change it.

        GMRES orthogonalises twice: directions by remembered corrections are nearly alike, and the residual
        might rise again. With films that a grid cannot hold only where needed.
        """
        ksp.setType(PETSc.KSP.Type.FGMRES)
        ksp.setOperators(self.jacobian.mat)
        ksp.setTolerances(rtol=rtol, atol=0.0, max_it=MOST_ITERATIONS)
        ksp.setGMRESRestart(self._restart)
        ksp.getPC().setType(PETSc.PC.Type.PYTHON)
        ksp.getPC().setPythonContext(self._preconditioner)
        how = "refine_always" if self._rough else "refine_ifneeded"
        with by_default(ksp.getOptionsPrefix(), ksp_gmres_cgs_refinement_type=how):
            ksp.setFromOptions()

    @property
    def _restart(self):
        """Iterations that GMRES remembers: all, unless the grid is so large that memory is short."""
        return RESTART_OF_LARGE if self._memory_is_short else MOST_ITERATIONS

    @property
    def _memory_is_short(self):
        return is_large(self.jacobian.grid.mesh)


@dataclass(frozen=True)
class _About:
    """What a grid of the cycle is linearised about; arrays (lines, nx)."""

    P: np.ndarray
    H: np.ndarray
    status: np.ndarray
    rows: np.ndarray
    rate: np.ndarray | float
    """1/time step, of each node or of all."""
    filling: np.ndarray | None
    eps: np.ndarray
    """Mobility of the finest grid, averaged in valleys."""

    @classmethod
    def finest(cls, evaluation, rows, rate):
        """That of the finest grid. Contents are corrected there alone: to coarse grids they are given."""
        P, H, status = (own(ghosted) for ghosted in (evaluation.P, evaluation.H, evaluation.status))
        rows = np.where((rows == FLOW) & (status == CAVITATED), PRESSURE, rows)
        filling = None if evaluation.filling is None else own(evaluation.filling)
        return cls(P, H, status, rows, rate, filling, own(evaluation.fluid.eps))

    def on_coarser(self, transfer, averages):
        """The same at the nodes of the next coarser grid; the mobility `averages` what lies around."""
        inject = transfer.inject
        return _About(
            inject(self.P), inject(self.H), inject(self.status), inject(self.rows),
            inject(self.rate) if np.ndim(self.rate) else self.rate,
            None if self.filling is None else inject(self.filling),
            transfer.averaged(self.eps) if averages else self.eps,
        )  # fmt: skip


def _evaluate(jacobian, contact, about):
    """The state of a coarse grid, evaluated as its Jacobian's scheme asks, of a contact with its oil."""
    grid, filling = jacobian.grid, about.filling
    ghosted = grid.halo(about.P), grid.halo(about.H), grid.halo_status(about.status)
    filling = None if filling is None else grid.halo(filling)
    return Evaluation(*ghosted, grid.mesh, contact, jacobian.scheme, filling=filling)
