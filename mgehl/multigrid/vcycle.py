"""The V-cycle itself: from the coarsest grid up, a relaxation on each grid, no convolution on the finest.

The deflection by a coarse grid's correction is convolved there and interpolated with it, instead of one
more convolution on the finer grid. The difference is as short as the finer grid's cells, and the relaxation
that follows damps it. A relaxation before the coarse grids would take two convolutions more on the finest
grid in every iteration, for little more than one relaxation's worth of convergence.
"""

import numpy as np


class VCycle:
    """Python context of a PC: one V-cycle from zero solves for x and gives y.

    Of the grids of the `jacobians`, coarsest first. Grid l > 0 has the smoother and the
    `PartitionedTransfer` l - 1; on grid 0 the `coarse` solve is direct. A smoother relaxes `visits` times a
    sweep.
    """

    def __init__(self, jacobians, transfers, smoothers, coarse, sweeps):
        self._jacobians, self._transfers, self._smoothers = jacobians, transfers, smoothers
        self._coarse, self._sweeps = coarse, sweeps

    def setUp(self, _pc):
        """Factor the bands and matrices of the present linearisation on all grids.

        The finest last, and then the coarsest: what a rank factors alone it factors while another does so.
        """
        for smoother in self._smoothers:
            smoother.factor()
        self._coarse.factor()

    def apply(self, _pc, x, y):
        """y = V x."""
        space = self._jacobians[-1].space
        space.write(y, *self._corrections(len(self._jacobians) - 1, *space.read_own(x)))

    def view(self, _pc, viewer):
        viewer.printfASCII(f"  V-cycle on {len(self._jacobians)} grids\n")
        for context in (self._coarse, *self._smoothers):
            context.view(viewer)

    def _corrections(self, level, r, load):
        """Of P, (lines, nx), and of H0 for a residual on a grid; the border on the last rank alone."""
        if level == 0:
            return self._coarse.solve(r, load)
        fine, coarse = self._jacobians[level], self._jacobians[level - 1]
        transfer = self._transfers[level - 1]
        load *= coarse.load_scale / fine.load_scale
        e, dH0 = self._corrections(level - 1, transfer.restrict(r), load)
        c = transfer.prolong(e)
        dH = None if fine.rigid else transfer.bilinear(coarse.deflection(e))
        return self._relaxed(level, r, c, dH, fine.space.border_in_team(dH0)), dH0

    def _relaxed(self, level, r, c, dH, dH0):
        """The correction `c`, whose deflection is `dH`, after the relaxations of grid `level`."""
        jacobian, smoother = self._jacobians[level], self._smoothers[level - 1]
        for left in range(self._sweeps * smoother.visits - 1, -1, -1):
            product = jacobian.product(c, dH, dH0)
            relaxed = smoother.relax(np.subtract(r, product, out=product))
            c += relaxed
            if left and not jacobian.rigid:
                dH += jacobian.deflection(relaxed)
        return c
