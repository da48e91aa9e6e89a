"""What GMRES found in earlier systems: the corrections that the cycle misses most, and their deflections.

Each valley that peaks shut in is a soft mode of its own. On coarse grids the valleys leak, so GMRES has to
find these modes, an iteration or more for each. They hardly change from one Newton step to the next, and
their deflections do not: the product with the new Jacobian takes a stencil and no convolution. Harmonic
Ritz values decide which are kept: GMRES with recycling [Parks et al., SIAM J. Sci. Comput. 28 (2006) 1651].
"""

from dataclasses import dataclass

import numpy as np
import scipy.linalg

MOST, NODES = 40, 48_000_000
"""Most corrections that are kept from one system to the next, and most nodes of all that are remembered at
a time: with their deflections and causes 1.2 GB. To keep the last ones instead of the softest fails."""

SOFT = 2.0
"""Cause over image from which on a correction is kept: the cycle leaves half of it or more. To keep all
that there is room for takes half more work, and time in films, where two or three are soft."""

INDEPENDENT = 1e-12
"""Smallest eigenvalue, over the largest, of images that count as independent of each other."""


@dataclass
class Corrections:
    """Corrections of P and H0, stacked; each array (corrections, entries of this rank)."""

    values: np.ndarray
    """With the border's entry on the last rank."""
    deflections: np.ndarray
    """By those of P, without the border."""
    causes: np.ndarray
    """The residuals to which the cycle answered with them."""

    @classmethod
    def stacked(cls, parts):
        """All of several (values, deflections, causes)."""
        return cls(*(np.array(each) for each in zip(*parts, strict=True)))

    def combined(self, weights):
        """New corrections, combined by `weights` (corrections, new ones)."""
        return Corrections(*(weights.T @ each for each in (self.values, self.deflections, self.causes)))

    def parts(self):
        """(values, deflections, causes) of each."""
        return list(zip(self.values, self.deflections, self.causes, strict=True))


class Memory:
    """Python context of a PC: first the best of the kept corrections, then a `cycle` on what is left. It
    sees every product of the `jacobian` with a correction of its own. Vectors are a rank's parts."""

    def __init__(self, jacobian, cycle):
        self._jacobian, self._cycle = jacobian, cycle
        self._room = int(max(NODES // jacobian.grid.mesh.nodes, 2))
        self._most = min(MOST, self._room // 2)
        self._seen, self._cause = [], None
        self._kept = self._images = None
        jacobian.witness = self._see

    @property
    def known(self):
        """All `Corrections` that the next system is solved with; None before the first."""
        return Corrections.stacked(self._seen) if self._seen else None

    @known.setter
    def known(self, corrections):
        self._seen = corrections.parts()

    def _see(self, dP, dH, dH0):
        """Remember the correction that was made last, and its deflection."""
        if self._cause is None:
            return
        value = np.empty(self._jacobian.space.local_size)
        self._jacobian.space.fill(value, dP, dH0)
        self._seen = [*self._seen, (value, dH.flatten(), self._cause)][-self._room :]
        self._cause = None

    def setUp(self, pc):
        """Multiply what is remembered by the present Jacobian, and keep what is soft."""
        self._cycle.setUp(pc)
        self._images = None
        if self._seen:
            self._take_over(Corrections.stacked(self._seen))

    def _take_over(self, known):
        """Keep combinations whose images are orthonormal."""
        images = self._products(known)
        weights = self._weights(images, known.causes)
        self._kept, self._images = known.combined(weights), weights.T @ images
        self._seen = self._kept.parts()

    def _products(self, known):
        """What the present Jacobian makes of corrections, (corrections, own entries)."""
        jacobian, space = self._jacobian, self._jacobian.space
        images = np.zeros_like(known.values)
        for value, dH, image in zip(known.values, known.deflections, images, strict=True):
            dP, dH0 = space.parts_in_team(value)
            load = jacobian.load_of(dP, dH0)
            product = jacobian.product(dP, dH.reshape(jacobian.grid.shape), dH0)
            space.fill(image, np.where(jacobian.given, 0.0, product), load)
            dP[jacobian.given] = 0.0
        return images

    def _weights(self, images, causes):
        """Of the combinations that are kept, (corrections, combinations): the same on all ranks."""
        comm = self._jacobian.grid.comm
        gram, by_causes = comm.allreduce(images @ images.T), comm.allreduce(images @ causes.T)
        return comm.bcast(softest(gram, by_causes, self._most) if comm.rank == 0 else None)

    def apply(self, pc, x, y):
        """y = what is kept for x, and what the cycle makes of the rest."""
        if self._images is None:
            self._cycle.apply(pc, x, y)
            self._cause = x.getArray().copy()
            return
        shares = self._jacobian.grid.comm.allreduce(self._images @ x.getArray(readonly=True))
        rest = x.duplicate()
        rest.setArray(x.getArray(readonly=True) - shares @ self._images)
        self._cycle.apply(pc, rest, y)
        y.getArray()[:] += shares @ self._kept.values
        self._cause = rest.getArray() + shares @ self._kept.causes
        rest.destroy()

    def view(self, pc, viewer):
        viewer.printfASCII(f"  the {self._most} softest corrections of the systems before\n")
        self._cycle.view(pc, viewer)


def softest(gram, by_causes, most):
    """Weights (corrections, combinations) of at `most` combinations with orthonormal images.

    `gram` are the products of the images with each other, `by_causes` those of image i with cause k.
    Combinations that depend on others are left out. Of the rest the `SOFT` are taken, softest first.
    """
    lengths = np.sqrt(np.diag(gram))
    scale = np.divide(1.0, lengths, out=np.zeros_like(lengths), where=lengths > 0.0)
    values, vectors = np.linalg.eigh(gram * np.outer(scale, scale))
    kept = values > INDEPENDENT * values[-1]
    weights = scale[:, None] * vectors[:, kept] / np.sqrt(values[kept])
    inverse_ritz, vectors = np.linalg.eig(weights.T @ by_causes @ weights)
    softness = np.abs(inverse_ritz)
    soft = vectors[:, np.argsort(-softness)[: min(most, np.count_nonzero(softness > SOFT))]]
    if not soft.size:
        return weights[:, :0]
    basis, triangle, _ = scipy.linalg.qr(np.hstack([soft.real, soft.imag]), mode="economic", pivoting=True)
    size = np.abs(np.diag(triangle))
    return weights @ basis[:, size > INDEPENDENT * size[0]][:, :most]
