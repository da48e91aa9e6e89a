"""One grid of the hierarchy: a mesh whose lines are dealt out to the ranks by a DMDA."""

import numpy as np
from mpi4py import MPI
from petsc4py import PETSc

from mgehl.discretization.axes import HALO
from mgehl.discretization.status import WALL


class Grid:
    """A `Mesh` decomposed along Y only; `shape` is (local lines, nx).

    `starts` are the first lines of all ranks and, last, the number of lines.
    """

    def __init__(self, mesh, starts, comm):
        self.mesh = mesh
        self.comm = comm
        self.starts = np.asarray(starts)
        self.first, self.last = int(self.starts[comm.rank]), int(self.starts[comm.rank + 1])
        self.shape = (self.last - self.first, mesh.nx)
        self.ghosted_shape = (self.shape[0] + 2 * HALO, mesh.nx)
        self.dm = PETSc.DMDA().create(
            dim=2,
            dof=1,
            sizes=(mesh.nx, mesh.ny),
            proc_sizes=(1, comm.size),
            ownership_ranges=((mesh.nx,), tuple(np.diff(self.starts))),
            boundary_type=(PETSc.DM.BoundaryType.NONE, PETSc.DM.BoundaryType.GHOSTED),
            stencil_type=PETSc.DMDA.StencilType.STAR,
            stencil_width=HALO,
            comm=comm,
        )
        self._global = self.dm.createGlobalVec()
        self._local = self.dm.createLocalVec()

    def destroy(self):
        """Free the PETSc objects (cyclic garbage collection can deadlock in parallel)."""
        for thing in (self._global, self._local, self.dm):
            thing.destroy()

    @property
    def X(self):
        """Coordinates along a line, shape (1, nx)."""
        return self.mesh.X[None, :]

    @property
    def Y(self):
        """Coordinates of the local lines, shape (lines, 1)."""
        return self.mesh.Y[self.first : self.last, None]

    def halo(self, array, out=None):
        """Copy of `array` with the neighbours' lines around it; outside the domain zero.

        `array` is (lines, nx) of any type that a double holds, the result (lines + 2 HALO, nx).
        """
        values = np.ascontiguousarray(array, dtype=float)
        ghosted = np.zeros(self.ghosted_shape) if out is None else out
        self._global.placeArray(values.ravel())
        self._local.placeArray(ghosted.ravel())
        self.dm.globalToLocal(self._global, self._local)
        self._local.resetArray()
        self._global.resetArray()
        return ghosted if ghosted.dtype == array.dtype or out is not None else ghosted.astype(array.dtype)

    def halo_status(self, status):
        """As `halo` for node statuses: what is outside the domain is WALL."""
        ghosted = self.halo(status)
        if self.first == 0:
            ghosted[:HALO] = WALL
        if self.last == self.mesh.ny:
            ghosted[-HALO:] = WALL
        return ghosted

    def refresh(self, ghosted):
        """Fetch the neighbours' lines into a ghosted array of doubles, in place."""
        self._local.placeArray(ghosted.ravel())
        self.dm.localToLocal(self._local, self._local)
        self._local.resetArray()

    def boundary(self):
        """True on the outermost nodes of the domain: (lines, nx)."""
        mask = np.zeros(self.shape, dtype=bool)
        mask[:, [0, -1]] = True
        lines = np.arange(self.first, self.last)
        if not self.mesh.is_line:
            mask[(lines == 0) | (lines == self.mesh.ny - 1)] = True
        return mask

    def sum(self, value):
        """Sum of one number per rank."""
        return self.comm.allreduce(float(value), MPI.SUM)

    def max(self, array, initial=-np.inf):
        """Largest value over all ranks' arrays."""
        return self.comm.allreduce(float(np.max(array, initial=initial)), MPI.MAX)

    def min(self, array, initial=np.inf):
        """Smallest value over all ranks' arrays."""
        return self.comm.allreduce(float(np.min(array, initial=initial)), MPI.MIN)

    def count(self, mask):
        """Number of True nodes over all ranks."""
        return self.comm.allreduce(int(np.count_nonzero(mask)), MPI.SUM)

    def value_at(self, array, i, j):
        """The value at node (i, j), known to every rank."""
        mine = float(array[j - self.first, i]) if self.first <= j < self.last else 0.0
        return self.comm.allreduce(mine, MPI.SUM)

    def gather(self, array):
        """The whole (ny, nx) array on rank 0, None elsewhere."""
        parts = self.comm.gather(np.ascontiguousarray(array))
        return None if parts is None else np.concatenate(parts)

    def scatter(self, whole):
        """The local lines of a whole array that rank 0 has."""
        parts = None
        if self.comm.rank == 0:
            parts = [
                whole[first:last] for first, last in zip(self.starts[:-1], self.starts[1:], strict=True)
            ]
        return np.array(self.comm.scatter(parts))


def single_grid(mesh, comm):
    """The grid of a mesh alone, its lines dealt out as by `build_grids`."""
    return build_grids(mesh, mesh.nx, comm)[0]


def build_grids(mesh, coarsest_nodes, comm):
    """Grids from the coarsest to `mesh`, each of every other node of the next.

    A coarse line belongs to the rank that owns the same fine line, so that every transfer needs
    one ghost line only. Raises ValueError when a rank would be left without lines.
    """
    meshes = [mesh]
    while meshes[-1].nx > coarsest_nodes and meshes[-1].nx % 2 and meshes[-1].ny % 2:
        meshes.append(meshes[-1].coarsened())
    starts = [rank * (mesh.ny // comm.size) + min(rank, mesh.ny % comm.size) for rank in range(comm.size)]
    all_starts = [np.array([*starts, mesh.ny])]
    for _ in meshes[1:]:
        all_starts.append((all_starts[-1] + 1) // 2)
    if comm.size > 1 and np.any(np.diff(all_starts[-1]) < 2):
        raise ValueError(f"{comm.size} ranks are too many for a coarsest grid of {meshes[-1].ny} lines")
    grids = [Grid(mesh, starts, comm) for mesh, starts in zip(meshes, all_starts, strict=True)]
    return grids[::-1]
