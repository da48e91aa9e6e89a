"""Deflection of the surfaces: a distributed convolution by FFT  [Liu eq. 51].

Boundary nodes carry no pressure, so the offsets between n - 2 sources and n nodes number
2n - 3 and a period of 2(n - 1), a power of two, holds them all without overlap. A single line
has the period 1 across. Only lines
that are not all zero are transformed, and padding is dropped as soon as it can be.
"""

import numpy as np
import pyfftw
from mpi4py import MPI

from mgehl.discretization.influence import influence_coefficients
from mgehl.grid.events import DEFLECTION, event
from mgehl.grid.transpose import Transpose

THREADS = 1
"""Of an FFT: the ranks share the work."""

TIMED, FIXED = ("FFTW_MEASURE",), ("FFTW_ESTIMATE",)
"""Plans: the fastest of several that are tried, along Y twice as fast on a large plane, or one always."""

LARGE = 1000
"""Nodes along Y from which on plans are timed: that takes half a second, and what it saves on 513 nodes
needs a hundred convolutions to pay for it."""

BLOCK = 16
"""Columns that are transformed at once. As fast as all at once, and its plan is found in a third of the
time."""


class Deflection:
    """D = K * P on one grid; `count` tells how many convolutions were made."""

    def __init__(self, grid, kernel):
        self.grid = grid
        self.count = 0
        self._convolution = _Convolution(grid, kernel) if grid.has_lines else None

    def destroy(self):
        """Free the MPI datatypes."""
        if self._convolution:
            self._convolution.destroy()

    @event(DEFLECTION)
    def __call__(self, P):
        """Deflection (lines, nx) by the pressure P (lines, nx), zero on boundary nodes.

        The result is a view that the next call overwrites. Ranks without lines take no part.
        """
        self.count += 1
        return self._convolution(P) if self._convolution else np.zeros(self.grid.shape)


class _Convolution:
    """The transforms of a rank with lines, planned, and the kernel's spectrum."""

    def __init__(self, grid, kernel):
        self.grid = grid
        mesh, (lines, nx) = grid.mesh, grid.shape
        self._transpose = Transpose(grid.team, grid.team_starts, nx, MPI.COMPLEX16)
        columns = self._transpose.columns
        self._x_real = pyfftw.zeros_aligned((lines, 2 * (nx - 1)))
        period_y = max(2 * (mesh.ny - 1), 1)
        self._x_modes = pyfftw.zeros_aligned((lines, nx), dtype=complex)
        self._y_modes = pyfftw.zeros_aligned((period_y, columns), dtype=complex)
        along_x = {"axes": (1,), "flags": FIXED, "threads": THREADS}
        self._x_forward = pyfftw.FFTW(self._x_real, self._x_modes, **along_x)
        self._x_backward = pyfftw.FFTW(self._x_modes, self._x_real, direction="FFTW_BACKWARD", **along_x)
        self._y_forward = _along_y(self._y_modes, "FFTW_FORWARD")
        self._y_backward = _along_y(self._y_modes, "FFTW_BACKWARD")
        self._spectrum = self._transform(kernel)

    def destroy(self):
        """Free the MPI datatypes."""
        self._transpose.destroy()

    def __call__(self, P):
        nx, ny = self.grid.mesh.nx, self.grid.mesh.ny
        self._x_real[:, :nx] = P
        self._x_real[:, nx:] = 0.0
        self._x_forward.execute()
        self._transpose.to_columns(self._x_modes, self._y_modes[:ny])
        self._y_modes[ny:] = 0.0
        self._y_forward()
        self._y_modes *= self._spectrum
        self._y_backward()
        self._transpose.to_lines(self._y_modes[:ny], self._x_modes)
        self._x_backward.execute()
        return self._x_real[:, :nx]

    def _transform(self, kernel):
        """Spectrum of the even kernel on this rank's columns, with the scale of the FFTs: real."""
        nx, ny = self.grid.mesh.nx, self.grid.mesh.ny
        K = influence_coefficients(self.grid.mesh, kernel, self.grid.first, self.grid.last)
        self._x_real[:, :nx] = K
        self._x_real[:, nx:] = K[:, -2:0:-1]
        self._x_forward.execute()
        self._transpose.to_columns(self._x_modes, self._y_modes[:ny])
        self._y_modes[ny:] = self._y_modes[ny - 2 : 0 : -1]
        self._y_forward()
        return self._y_modes.real / (self._x_real.shape[1] * self._y_modes.shape[0])


def _along_y(modes, direction):
    """Function that transforms all columns in place, block by block."""
    how = {"direction": direction, "flags": TIMED if len(modes) > 2 * LARGE else FIXED, "threads": THREADS}
    blocks = [modes[:, first : first + BLOCK] for first in range(0, modes.shape[1], BLOCK)]
    plans = [pyfftw.FFTW(block, block, axes=(0,), **how) for block in blocks]

    def transform():
        for plan in plans:
            plan.execute()

    return transform
