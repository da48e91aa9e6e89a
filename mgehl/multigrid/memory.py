"""What GMRES learnt in the linear systems before: corrections, and their deflections.

On a rough surface each peak that carries load is a soft mode of its own, which coarse grids know badly:
GMRES finds it by itself, an iteration for each. From one Newton step to the next the modes hardly change.
And the deflection of a correction does not change at all: what the new Jacobian makes of a remembered one
is a stencil, without a convolution.
"""

import numpy as np

from mgehl.grid.events import LINES, event

MOST, NODES = 40, 16_000_000
"""Corrections that are remembered at the most, and nodes of all of them: with their deflections 256 MB."""

INDEPENDENT = 1e-12
"""Part of the largest eigenvalue from which what the corrections lead to is taken for independent."""


class Memory:
    """Python context of a PC: the best of what is remembered, and a `cycle` on the residual that it leaves.

    It sees every product of the `jacobian` with a correction. Vectors are a rank's own parts.
    """

    def __init__(self, jacobian, cycle):
        self._jacobian, self._cycle = jacobian, cycle
        self._most = int(min(MOST, max(NODES // jacobian.grid.mesh.nodes, 1)))
        self._seen, self._images = [], None
        jacobian.witness = self._see

    def _see(self, dP, dH, dH0):
        """Remember a correction and its deflection."""
        self._seen = [*self._seen, (dP.copy(), dH.copy(), dH0)][-self._most :]

    def setUp(self, pc):
        """Take what is remembered to the present linearisation."""
        self._cycle.setUp(pc)
        self._images = None
        if self._seen:
            self._orthonormalise(*self._products())

    @event(LINES)
    def _products(self):
        """What is remembered and its products with J, each (remembered, own entries)."""
        jacobian, space = self._jacobian, self._jacobian.space
        shape = len(self._seen), space.local_size
        corrections, images = np.zeros(shape), np.zeros(shape)
        for correction, image, (dP, dH, dH0) in zip(corrections, images, self._seen, strict=True):
            load = jacobian.load_weight * jacobian.grid.sum_of_team(dP.sum())
            space.fill(correction, np.where(jacobian.given, 0.0, dP), dH0)
            space.fill(image, np.where(jacobian.given, 0.0, jacobian.product(dP, dH, dH0)), load)
        return corrections, images

    @event(LINES)
    def _orthonormalise(self, corrections, images):
        """Combine them until the images are orthonormal; those that depend on others are left out."""
        comm = self._jacobian.grid.comm
        lengths = np.sqrt(comm.allreduce(np.einsum("ki,ki->k", images, images)))
        scale = np.divide(1.0, lengths, out=np.zeros_like(lengths), where=lengths > 0.0)
        gram = comm.allreduce(images @ images.T) * np.outer(scale, scale)
        values, vectors = np.linalg.eigh(gram)
        kept = values > INDEPENDENT * values[-1]
        combination = scale[:, None] * vectors[:, kept] / np.sqrt(values[kept])
        self._corrections, self._images = combination.T @ corrections, combination.T @ images

    def apply(self, pc, x, y):
        """y = what is remembered for x, and what the cycle makes of the rest."""
        if self._images is None:
            self._cycle.apply(pc, x, y)
            return
        shares = self._jacobian.grid.comm.allreduce(self._images @ x.getArray(readonly=True))
        rest = x.duplicate()
        rest.setArray(x.getArray(readonly=True) - shares @ self._images)
        self._cycle.apply(pc, rest, y)
        y.getArray()[:] += shares @ self._corrections
        rest.destroy()

    def view(self, pc, viewer):
        viewer.printfASCII(f"  at most {self._most} corrections of the systems before\n")
        self._cycle.view(pc, viewer)
