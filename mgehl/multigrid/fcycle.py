"""The cycle itself: from the coarsest grid up, a relaxation on each grid, no convolution on the finest.

The deflection by a coarse correction is interpolated, and relaxation damps the difference. A relaxation
before the coarse grids would take two convolutions more for little more than its own worth.

At a thick film's spike coarse corrections overshoot, the more the more grids there are. So F visits the
next coarser grid twice, first by F and then by V, where that grid holds the film: the second visit takes
back what the first one overshot. Elsewhere it is another spike, and a second visit leads astray.
"""

import numpy as np

SECOND = 0.8
"""How much of the second visit's correction is taken: with all of it thick films take more work."""


class FCycle:
    """Python context of a PC: one cycle from zero solves for x and gives y, on the grids of the
    `jacobians`, coarsest first. Grid l > 0 has the smoother and the `PartitionedTransfer` l - 1; on grid 0
    the `coarse` solve is direct."""

    def __init__(self, jacobians, transfers, smoothers, coarse, sweeps):
        self._jacobians, self._transfers, self._smoothers = jacobians, transfers, smoothers
        self._coarse, self._sweeps = coarse, sweeps

    def setUp(self, _pc):
        """Factor the bands and matrices of the present linearisation on all grids. What one rank factors
        alone comes last: the first one does its part while the last one does another."""
        for smoother in self._smoothers:
            smoother.factor()
        for smoother in self._smoothers:
            smoother.factor_alone()
        self._coarse.factor()

    def apply(self, _pc, x, y):
        """y = F x."""
        space = self._jacobians[-1].space
        space.write(y, *self._corrections(len(self._jacobians) - 1, *space.read_own(x), again=True))

    def view(self, _pc, viewer):
        grids = len(self._jacobians)
        twice = sum(self._is_visited_twice(level) for level in range(grids - 1))
        name = f"F-cycle, {twice} of them visited twice" if twice else "V-cycle"
        if grids > 1:
            viewer.printfASCII(f"  {grids} grids, {name}\n")
        for context in (self._coarse, *self._smoothers):
            context.view(viewer)

    def _is_visited_twice(self, level):
        """Whether a coarse grid is: those that hold the film see cliffs. The coarsest solve is direct."""
        return level > 0 and self._smoothers[level - 1].sees_cliffs

    def _corrections(self, level, r, load, again):
        """Of P, (lines, nx), and of H0 for a residual on a grid; the border on the last rank alone. `again`
        says whether coarser grids may be visited twice."""
        if level == 0:
            return self._coarse.solve(r, load)
        fine, coarse = self._jacobians[level], self._jacobians[level - 1]
        transfer = self._transfers[level - 1]
        load *= coarse.load_scale / fine.load_scale
        e, dH, dH0 = self._coarse_corrections(level - 1, transfer.restrict(r), load, again)
        c = transfer.prolong(e)
        dH = transfer.bilinear(dH)
        return self._relaxed(level, r, c, dH, fine.space.border_in_team(dH0)), dH0

    def _coarse_corrections(self, level, r, load, again):
        """Of P, its deflection, and of H0, after one or two visits to a grid."""
        jacobian = self._jacobians[level]
        e, dH0 = self._corrections(level, r, load, again)
        dH = jacobian.deflection(e)
        if not (again and self._is_visited_twice(level)):
            return e, dH, dH0
        dH = dH.copy()  # the next deflection on this grid overwrites it
        rest = r - jacobian.product(e, dH, jacobian.space.border_in_team(dH0))
        more, more_H0 = self._corrections(level, rest, load - jacobian.load_of(e, dH0), again=False)
        more *= SECOND
        e += more
        dH += jacobian.deflection(more)
        return e, dH, dH0 + SECOND * more_H0

    def _relaxed(self, level, r, c, dH, dH0):
        """The correction `c`, whose deflection is `dH`, after the relaxations of grid `level`."""
        jacobian, smoother = self._jacobians[level], self._smoothers[level - 1]
        for to_come in range(self._sweeps - 1, -1, -1):
            product = jacobian.product(c, dH, dH0)
            relaxed = smoother.relax(np.subtract(r, product, out=product))
            c += relaxed
            if to_come:
                dH += jacobian.deflection(relaxed)
        return c
