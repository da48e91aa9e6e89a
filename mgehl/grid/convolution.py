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

INVERSE_WORK = 0.25
"""Of `Deflection.inverted`, in convolutions: its transforms are half as long along X and along Y."""

SMALLEST = 1e-8
"""Least entry of a spectrum over its largest that is inverted: what is smaller may be rounding."""

BLOCK = 16
"""Columns that are transformed at once. As fast as all at once, and its plan is found in a third of the
time."""


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
        for transforms in (self._convolution, self._inverse):
            if transforms:
                transforms.destroy()

    @event(DEFLECTION)
    def __call__(self, P):
        """Deflection (lines, nx) by the pressure P (lines, nx), zero on boundary nodes.

        The result is a view that the next call overwrites. Ranks without lines take no part.
        """
        self.count += 1
        return self._convolution(P) if self._convolution else np.zeros(self.grid.shape)

    @event(DEFLECTION)
    def inverted(self, D):
        """Roughly the pressure (lines, nx), less its mean, that deflects the surfaces by D (lines, nx).

        It is that of pressures and surfaces which repeat themselves from one end of the domain to the
        other: symmetric and positive, as a preconditioner must be, and as good on every grid. A view that
        the next call overwrites; counted as `INVERSE_WORK`.
        """
        self.count += INVERSE_WORK
        if not self._convolution:
            return np.zeros(self.grid.shape)
        self._inverse = self._inverse or _Inverse(self.grid, self._kernel)
        return self._inverse(D)


class _Transforms:
    """The transforms of a rank with lines, planned, and a spectrum by which they multiply."""

    def __init__(self, grid, period_x, period_y):
        """`period_x` is even; nodes that a period has no room for are those of the domain's boundary."""
        self.grid = grid
        lines, modes = grid.shape[0], period_x // 2 + 1
        self._transpose = Transpose(grid.team, grid.team_starts, modes, MPI.COMPLEX16)
        self._x_real = pyfftw.zeros_aligned((lines, period_x))
        self._x_modes = pyfftw.zeros_aligned((lines, modes), dtype=complex)
        rows = max(period_y, grid.mesh.ny)
        self._received = pyfftw.zeros_aligned((rows, self._transpose.width), dtype=complex)
        self._y_modes = self._received[:period_y, : self._transpose.columns]
        along_x = {"axes": (1,), "flags": FIXED, "threads": THREADS}
        self._x_forward = pyfftw.FFTW(self._x_real, self._x_modes, **along_x)
        self._x_backward = pyfftw.FFTW(self._x_modes, self._x_real, direction="FFTW_BACKWARD", **along_x)
        self._y_forward = _along_y(self._y_modes, "FFTW_FORWARD")
        self._y_backward = _along_y(self._y_modes, "FFTW_BACKWARD")

    def destroy(self):
        """Free the MPI datatypes."""
        self._transpose.destroy()

    def _transform(self, nodes):
        """Modes of real `nodes` (lines, up to a period), on this rank's columns."""
        there, ny = nodes.shape[1], self.grid.mesh.ny
        self._x_real[:, :there] = nodes
        self._x_real[:, there:] = 0.0
        self._x_forward.execute()
        self._transpose.to_columns(self._x_modes, self._received[:ny])
        self._received[ny:] = 0.0
        self._y_forward()

    def _transform_back(self):
        """Real nodes (lines, period) of the modes."""
        self._y_backward()
        self._received[len(self._y_modes) :] = 0.0
        self._transpose.to_lines(self._received[: self.grid.mesh.ny], self._x_modes)
        self._x_backward.execute()
        return self._x_real

    @property
    def _scale(self):
        """By which a transform and the way back multiply."""
        return self._x_real.shape[1] * self._y_modes.shape[0]


class _Convolution(_Transforms):
    """The product with the kernel."""

    def __init__(self, grid, kernel):
        mesh = grid.mesh
        super().__init__(grid, 2 * (mesh.nx - 1), max(2 * (mesh.ny - 1), 1))
        self._spectrum = self._spectrum_of(kernel)

    def __call__(self, P):
        self._transform(P)
        self._y_modes *= self._spectrum
        return self._transform_back()[:, : self.grid.mesh.nx]

    def _spectrum_of(self, kernel):
        """Spectrum of the even kernel on this rank's columns, with the scale of the FFTs: real."""
        nx, ny = self.grid.mesh.nx, self.grid.mesh.ny
        K = influence_coefficients(self.grid.mesh, kernel, self.grid.first, self.grid.last)
        self._x_real[:, :nx] = K
        self._x_real[:, nx:] = K[:, -2:0:-1]
        self._x_forward.execute()
        self._transpose.to_columns(self._x_modes, self._received[:ny])
        self._y_modes[ny:] = self._y_modes[ny - 2 : 0 : -1]
        self._y_forward()
        return self._y_modes.real / self._scale


class _Inverse(_Transforms):
    """The product with one over the spectrum of the kernel that ends half a domain away."""

    def __init__(self, grid, kernel):
        mesh = grid.mesh
        super().__init__(grid, mesh.nx - 1, max(mesh.ny - 1, 1))
        self._result = np.zeros(grid.shape)
        self._spectrum = self._spectrum_of(kernel)

    def __call__(self, D):
        self._transform(D[:, :-1])
        self._y_modes *= self._spectrum
        self._result[:, :-1] = self._transform_back()
        return self._result

    def _spectrum_of(self, kernel):
        """On this rank's columns, with the scale of the FFTs: positive, and 0 of the mean."""
        mesh, x = self.grid.mesh, self.grid.mesh.nx - 1
        lines = np.arange(self.grid.first, self.grid.last)
        lines = np.minimum(lines, np.abs(mesh.ny - 1 - lines))
        K = influence_coefficients(mesh, kernel, lines.min(), lines.max() + 1)[lines - lines.min()]
        self._transform(K[:, np.minimum(np.arange(x), x - np.arange(x))])
        size = np.abs(self._y_modes.real)
        largest = self.grid.team.allreduce(float(np.max(size, initial=0.0)), MPI.MAX)
        found = 1.0 / (np.maximum(size, SMALLEST * largest) * self._scale)
        if self.grid.team.rank == 0:
            found[0, 0] = 0.0
        return found


def _along_y(modes, direction):
    """Function that transforms all columns in place, block by block."""
    how = {"direction": direction, "flags": TIMED if len(modes) > 2 * LARGE else FIXED, "threads": THREADS}
    blocks = [modes[:, first : first + BLOCK] for first in range(0, modes.shape[1], BLOCK)]
    plans = [pyfftw.FFTW(block, block, axes=(0,), **how) for block in blocks]

    def transform():
        for plan in plans:
            plan.execute()

    return transform
