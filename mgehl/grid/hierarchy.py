"""The grids of a run, coarsest first, with what connects them and the count of convolutions."""

from copy import copy

from mgehl.grid.convolution import Deflection
from mgehl.grid.events import SETUP, event
from mgehl.grid.freed_memory import give_back_large_arrays, is_large
from mgehl.grid.grid import build_grids
from mgehl.grid.transfers import Transfer


class Hierarchy:
    """Grids, the transfers between neighbours and the deflection operator on each. `transfers[l]` leads
    from grid l to grid l + 1."""

    @event(SETUP)
    def __init__(self, mesh, coarsest_nodes, kernel, comm):
        if is_large(mesh):
            give_back_large_arrays()
        self.grids = build_grids(mesh, coarsest_nodes, comm)
        self.transfers = [Transfer(*pair) for pair in zip(self.grids[:-1], self.grids[1:], strict=True)]
        self.deflections = [Deflection(grid, kernel) for grid in self.grids]
        self._made_before = 0.0

    @property
    def convolutions(self):
        """Convolutions made so far, in equivalents of one on the finest grid (by node ratio)."""
        return self._made_before + self._made_here

    @property
    def _made_here(self):
        work = sum(deflection.count * deflection.grid.mesh.nodes for deflection in self.deflections)
        return work / self.grids[-1].mesh.nodes

    def go_on(self, convolutions):
        """Count on from what a run had made before it was stopped."""
        self._made_before = convolutions - self._made_here

    def coarser(self):
        """The same without its finest grid, which counts from nothing; its grids go with these."""
        rest = copy(self)
        for name in ("grids", "transfers", "deflections"):
            setattr(rest, name, getattr(self, name)[:-1])
        rest.go_on(0.0)
        return rest

    def destroy(self):
        """Free the PETSc and MPI objects of the grids."""
        for thing in (*self.deflections, *self.grids):
            thing.destroy()
