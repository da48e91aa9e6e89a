"""One grid of the hierarchy: a mesh whose lines are dealt out to the ranks by a DMDA."""

import numpy as np
from mpi4py import MPI
from petsc4py import PETSc

from mgehl.discretization.mesh import HALO
from mgehl.discretization.status import WALL
from mgehl.grid.ownership import active_ranks, ownerships


class Grid:
    """A `Mesh` decomposed along Y only; `shape` is (local lines, nx). `starts` are the first lines of all
    ranks and, last, the number of lines. On a coarse grid some ranks hold no line; the others are its
    `team`, a communicator. What is not said to be the team's is called by all ranks of `comm`."""

    def __init__(self, mesh, starts, comm):
        self.mesh = mesh
        self.comm = comm
        self.starts = np.asarray(starts)
        self.first, self.last = int(self.starts[comm.rank]), int(self.starts[comm.rank + 1])
        self.shape = (self.last - self.first, mesh.nx)
        self.ghosted_shape = (self.shape[0] + 2 * HALO, mesh.nx)
        self.has_lines = self.first < self.last
        active = active_ranks(self.starts)
        self._all_are_active = len(active) == comm.size
        self.team = self._split()
        self.team_starts = np.append(self.starts[active], mesh.ny)
        if self.has_lines:
            self._create_dm()

    def _split(self):
        """The communicator of the ranks with lines; MPI's null on the others."""
        if self._all_are_active:
            return self.comm
        return self.comm.Split(0 if self.has_lines else MPI.UNDEFINED, self.comm.rank)

    def _create_dm(self):
        """PETSc's objects for the exchange of lines, on the team."""
        nx, ny = self.mesh.nx, self.mesh.ny
        self._dm = PETSc.DMDA().create(
            dim=2,
            dof=1,
            sizes=(nx, ny),
            proc_sizes=(1, self.team.size),
            ownership_ranges=((nx,), tuple(np.diff(self.team_starts))),
            boundary_type=(PETSc.DM.BoundaryType.NONE, PETSc.DM.BoundaryType.GHOSTED),
            stencil_type=PETSc.DMDA.StencilType.STAR,
            stencil_width=HALO,
            comm=self.team,
        )
        self._global = self._dm.createGlobalVec()
        self._local = self._dm.createLocalVec()

    def destroy(self):
        """Free the PETSc and MPI objects (cyclic garbage collection can deadlock in parallel)."""
        if self.has_lines:
            for thing in (self._global, self._local, self._dm):
                thing.destroy()
            if not self._all_are_active:
                self.team.Free()

    @property
    def X(self):
        """Coordinates along a line, shape (1, nx)."""
        return self.mesh.X[None, :]

    @property
    def Y(self):
        """Coordinates of the local lines, shape (lines, 1)."""
        return self.mesh.Y[self.first : self.last, None]

    def halo(self, array, out=None):
        """Copy of `array`, (lines, nx) of any type that a double holds, with the neighbours' lines around
        it: (lines + 2 HALO, nx); outside the domain zero. The team's."""
        if self.comm.size == 1:
            return self._with_nothing_around(array, out)
        ghosted = np.zeros(self.ghosted_shape) if out is None else out
        if self.has_lines:
            values = np.ascontiguousarray(array, dtype=float)
            self._global.placeArray(values.ravel())
            self._local.placeArray(ghosted.ravel())
            self._dm.globalToLocal(self._global, self._local)
            self._local.resetArray()
            self._global.resetArray()
        return ghosted if ghosted.dtype == array.dtype or out is not None else ghosted.astype(array.dtype)

    def _with_nothing_around(self, array, out):
        """The halo of a rank that is alone: a copy, without PETSc's two more."""
        if out is None:
            out = np.empty(self.ghosted_shape, array.dtype)
            out[:HALO] = out[-HALO:] = 0
        out[HALO:-HALO] = array
        return out

    def lines_around(self, array, count):
        """As `halo`, the team's too, with `count` lines of each neighbour; (lines + 2 count, nx). Each must
        have as many: at most `ownership.MIN_LINES`."""
        lines, team = len(array), self.team
        around = np.zeros((lines + 2 * count, *array.shape[1:]), array.dtype)
        around[count : count + lines] = array
        before = team.rank - 1 if team.rank else MPI.PROC_NULL
        behind = team.rank + 1 if team.rank + 1 < team.size else MPI.PROC_NULL
        team.Sendrecv(around[count : 2 * count], before, recvbuf=around[count + lines :], source=behind)
        team.Sendrecv(around[lines : count + lines], behind, recvbuf=around[:count], source=before)
        return around

    def halo_status(self, status):
        """As `halo` for node statuses: what is outside the domain is WALL."""
        ghosted = self.halo(status)
        if self.first == 0:
            ghosted[:HALO] = WALL
        if self.last == self.mesh.ny:
            ghosted[-HALO:] = WALL
        return ghosted

    def refresh(self, ghosted):
        """Fetch the neighbours' lines into a ghosted array of doubles, in place (the team's)."""
        if self.has_lines and self.comm.size > 1:
            self._local.placeArray(ghosted.ravel())
            self._dm.localToLocal(self._local, self._local)
            self._local.resetArray()

    def boundary(self):
        """True on the outermost nodes of the domain: (lines, nx)."""
        mask = np.zeros(self.shape, dtype=bool)
        mask[:, [0, -1]] = True
        lines = np.arange(self.first, self.last)
        if not self.mesh.is_line:
            mask[(lines == 0) | (lines == self.mesh.ny - 1)] = True
        return mask

    def beside_boundary(self):
        """Masks (lines, nx) of the nodes next to the ends of X, and of those next to the ends of Y."""
        beside_x, beside_y = np.zeros((2, *self.shape), dtype=bool)
        beside_x[:, [1, -2]] = True
        lines = np.arange(self.first, self.last)
        if not self.mesh.is_line:
            beside_y[(lines == 1) | (lines == self.mesh.ny - 2)] = True
        return beside_x, beside_y

    def sum(self, value):
        """Sum of one number per rank."""
        return self.comm.allreduce(float(value), MPI.SUM)

    def sum_of_team(self, value):
        """As `sum`, over the team alone: the same but for rounding, known to ranks with lines only."""
        total = np.array(value, dtype=float)
        if self.has_lines:
            self.team.Allreduce(MPI.IN_PLACE, total)
        return float(total)

    def max(self, array, initial=-np.inf):
        """Largest value over all ranks' arrays."""
        return self.comm.allreduce(float(np.max(array, initial=initial)), MPI.MAX)

    def min(self, array, initial=np.inf):
        """Smallest value over all ranks' arrays."""
        return self.comm.allreduce(float(np.min(array, initial=initial)), MPI.MIN)

    def count(self, mask):
        """Number of True nodes over all ranks."""
        return self.comm.allreduce(int(np.count_nonzero(mask)), MPI.SUM)

    def gather(self, array):
        """The whole (..., ny, nx) array on rank 0, None elsewhere: for what is written or shown."""
        several, size = array.shape[:-2], (self.mesh.ny, self.mesh.nx)
        whole = np.empty((*several, *size), array.dtype) if self.comm.rank == 0 else None
        for each in np.ndindex(several):
            target = None if whole is None else whole[each]
            self.comm.Gatherv(np.ascontiguousarray(array[each]), self._parts(target, self.starts))
        return whole

    def on_first(self, function, *arrays):
        """What a `function` of whole arrays returns, called on rank 0 and told to all (collective)."""
        whole = [self.gather(each) for each in arrays]
        return self.comm.bcast(None if self.comm.rank else function(*whole))

    def to_last(self, array):
        """The whole (ny, nx) array on the team's last rank, None on the others: for a coarsest grid."""
        last = self.team.size - 1
        whole = np.empty((self.mesh.ny, self.mesh.nx), array.dtype) if self.team.rank == last else None
        self.team.Gatherv(np.ascontiguousarray(array), self._parts(whole, self.team_starts), root=last)
        return whole

    def from_last(self, whole):
        """The local lines, (lines, nx), of a whole array of doubles that the team's last rank has."""
        local = np.empty(self.shape)
        self.team.Scatterv(self._parts(whole, self.team_starts), local, root=self.team.size - 1)
        return local

    def scatter(self, whole):
        """The local lines, (..., lines, nx), of a whole array that rank 0 has."""
        several, dtype = self.comm.bcast(None if whole is None else (whole.shape[:-2], whole.dtype))
        local = np.empty((*several, *self.shape), dtype)
        for each in np.ndindex(several):
            source = None if whole is None else whole[each]
            self.comm.Scatterv(self._parts(source, self.starts), local[each])
        return local

    def _parts(self, whole, starts):
        """What MPI takes for a whole array, (ny, nx), dealt out in lines; None of ranks that have none."""
        return None if whole is None else (np.ascontiguousarray(whole), np.diff(starts) * self.mesh.nx)


def single_grid(mesh, comm):
    """The grid of a mesh alone, its lines dealt out as by `build_grids`."""
    return build_grids(mesh, mesh.nx, comm)[0]


def meshes_of(mesh, coarsest_nodes):
    """Meshes from the coarsest to `mesh`, each of every other node of the next."""
    meshes = [mesh]
    while meshes[0].nx > coarsest_nodes and meshes[0].nx % 2 and meshes[0].ny % 2:
        meshes.insert(0, meshes[0].coarsened())
    return meshes


def build_grids(mesh, coarsest_nodes, comm):
    """Grids from the coarsest to `mesh`, each of every other node of the next. A coarse line belongs to the
    rank of the same fine line, so transfers need ghost lines only; fewer ranks share one of few lines."""
    meshes = meshes_of(mesh, coarsest_nodes)
    starts = ownerships(mesh.ny, len(meshes), comm.size)[::-1]
    return [Grid(*each, comm) for each in zip(meshes, starts, strict=True)]
