"""Deflection of the surfaces: a distributed convolution by FFT  [Liu eq. 51].

Boundary nodes carry no pressure: a period of 2(n - 1), a power of two, holds all 2n - 3 offsets between n -
2 sources and n nodes. A single line has the period 1 across.
"""

import numpy as np
from mpi4py import MPI

from mgehl.discretization.influence import influence_coefficients
from mgehl.grid.events import DEFLECTION, event
from mgehl.grid.transforms import PlaneTransforms

INVERSE_WORK = 0.25
"""Of `Deflection.inverted`, in convolutions: its transforms are half as long along X and along Y."""

SMALLEST = 1e-8
"""Least entry of a spectrum over its largest that is inverted: what is smaller may be rounding."""


class Deflection:
    """D = K * P on one grid; `count` tells how many convolutions were made."""

    def __init__(self, grid, kernel):
        self.grid = grid
        self.count = 0
        self._kernel = kernel
        self._convolution = _Convolution(grid, kernel) if grid.has_lines else None
        self._inverse = None

    def destroy(self):
        """Free the MPI datatypes."""
        for product in (self._convolution, self._inverse):
            if product:
                product.transforms.destroy()

    @event(DEFLECTION)
    def __call__(self, P):
        """Deflection (lines, nx) by the pressure P (lines, nx), zero on boundary nodes. The result is a
        view that the next call overwrites. Ranks without lines take no part."""
        self.count += 1
        return self._convolution(P) if self._convolution else np.zeros(self.grid.shape)

    @event(DEFLECTION)
    def inverted(self, D):
        """Roughly the pressure (lines, nx), less its mean, that deflects the surfaces by D (lines, nx).

        That of a periodic domain: symmetric and positive, as a preconditioner must be, and as good on every
        grid. A view that the next call overwrites; counted as `INVERSE_WORK`.
        """
        self.count += INVERSE_WORK
        if not self._convolution:
            return np.zeros(self.grid.shape)
        self._inverse = self._inverse or _Inverse(self.grid, self._kernel)
        return self._inverse(D)


class _Convolution:
    """The product with the kernel."""

    def __init__(self, grid, kernel):
        mesh = grid.mesh
        self.transforms = PlaneTransforms(grid, 2 * (mesh.nx - 1), max(2 * (mesh.ny - 1), 1))
        self._result = np.zeros(grid.shape)
        K = influence_coefficients(mesh, kernel, grid.first, grid.last)
        self._spectrum = self.transforms.spectrum(K)
        self._spectrum /= self.transforms.scale

    def __call__(self, P):
        self.transforms.product(P, self._spectrum, self._result)
        return self._result


class _Inverse:
    """The product with one over the spectrum of the kernel that ends half a domain away."""

    def __init__(self, grid, kernel):
        mesh = grid.mesh
        self.transforms = PlaneTransforms(grid, mesh.nx - 1, max(mesh.ny - 1, 1))
        self._result = np.zeros(grid.shape)
        self._spectrum = self._inverse_spectrum(grid, kernel)

    def __call__(self, D):
        self.transforms.product(D[:, :-1], self._spectrum, self._result[:, :-1])
        return self._result

    def _inverse_spectrum(self, grid, kernel):
        """Positive, and 0 of the mean."""
        mesh, x = grid.mesh, grid.mesh.nx - 1
        lines = np.arange(grid.first, grid.last)
        lines = np.minimum(lines, np.abs(mesh.ny - 1 - lines))
        K = influence_coefficients(mesh, kernel, lines.min(), lines.max() + 1)[lines - lines.min()]
        size = np.abs(self.transforms.spectrum(K[:, np.minimum(np.arange(x), x - np.arange(x))]))
        largest = grid.team.allreduce(float(np.max(size, initial=0.0)), MPI.MAX)
        found = 1.0 / (np.maximum(size, SMALLEST * largest) * self.transforms.scale)
        if grid.team.rank == 0:
            found[0, 0] = 0.0
        return found
