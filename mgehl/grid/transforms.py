"""Fourier transforms of a plane whose lines are dealt out to ranks.

A few lines at a time are copied to a block that stays in the cache, padded there and transformed. So no
padded plane is ever held: a convolution takes two thirds of the time and less than half of the memory.
"""

import numpy as np
import pyfftw

from mgehl.grid.plane import even_shares, planes_of

THREADS = 1
"""Of an FFT: the ranks share the work."""

TIMED, FIXED = ("FFTW_MEASURE",), ("FFTW_ESTIMATE",)
"""Plans: the fastest of several that are tried, on 4097 nodes a third faster, or one always."""

LARGE = 4000
"""Nodes of a period from which on plans are timed: that takes a second, which 1025 nodes do not give back.
Never a single line's: another plan has other last digits."""

BLOCK = 32_768
"""Numbers of a block: half a megabyte where they are complex."""


class PlaneTransforms:
    """Planned transforms of a rank with lines, of periodic planes. The spectrum of an even kernel is real
    and even: half is stored, (columns, period_y // 2 + 1), of this rank's columns of modes."""

    def __init__(self, grid, period_x, period_y):
        """`period_x` is even; nodes that a period has no room for are those of the domain's boundary."""
        lines, modes = grid.shape[0], period_x // 2 + 1
        widths = [end - first for first, end in even_shares(modes, grid.team.size)]
        (self._modes,) = planes_of(grid.team, grid.team_starts, widths, complex)
        self._along_x = _AlongX(period_x, lines)
        self._along_y = _AlongY(period_y, self._modes.columns.shape[1])
        self.scale = period_x * period_y
        """By which a product is larger than it should be."""

    def destroy(self):
        """Free the MPI datatypes."""
        self._modes.destroy()

    def spectrum(self, kernel):
        """That of an even `kernel` (lines, up to a period): the rest of the period is its mirror image."""
        self._along_x.forward(kernel, self._modes.lines, even=True)
        self._modes.to_columns()
        spectrum = self._along_y.spectrum(self._modes.columns)
        self._modes.release()
        return spectrum

    def product(self, nodes, spectrum, out):
        """Convolve `nodes` (lines, up to a period) with the kernel of a `spectrum`; write `out`, as wide.
        It is `scale` times too large."""
        self._along_x.forward(nodes, self._modes.lines)
        self._modes.to_columns()
        self._along_y.multiply(self._modes.columns, spectrum)
        self._modes.to_lines()
        self._along_x.backward(self._modes.lines, out)


class _AlongX:
    """Between real lines and their modes."""

    def __init__(self, period, lines):
        height = _lines_of_a_block(period, lines)
        self._real = pyfftw.zeros_aligned((height, period))
        self._modes = pyfftw.zeros_aligned((height, period // 2 + 1), dtype=complex)
        self._to_modes = _planned(self._real, self._modes, "FFTW_FORWARD")
        self._to_real = _planned(self._modes, self._real, "FFTW_BACKWARD")

    def forward(self, nodes, modes, even=False):
        """Write the `modes` of lines of `nodes`; the rest of a period is zero or, if `even`, the image."""
        there = nodes.shape[1]
        for block, count in self._blocks(nodes):
            self._real[:count, :there] = nodes[block]
            self._real[:, there:] = _mirrored(self._real, there) if even else 0.0
            self._to_modes.execute()
            modes[block] = self._modes[:count]

    def backward(self, modes, nodes):
        """Write the first `nodes` of lines with these `modes`."""
        there = nodes.shape[1]
        for block, count in self._blocks(modes):
            self._modes[:count] = modes[block]
            self._to_real.execute()
            nodes[block] = self._real[:count, :there]

    def _blocks(self, lines):
        return _blocks(len(lines), len(self._real))


class _AlongY:
    """The product with a spectrum of columns of modes along X."""

    def __init__(self, period, columns):
        self._block = pyfftw.zeros_aligned((_lines_of_a_block(period, columns), period), dtype=complex)
        self._forward = _planned(self._block, self._block, "FFTW_FORWARD")
        self._backward = _planned(self._block, self._block, "FFTW_BACKWARD")
        self._half = period // 2 + 1

    def spectrum(self, columns):
        """Of columns (lines, columns) that are even and real but for rounding."""
        found = np.empty((columns.shape[1], self._half))
        for block, count in self._blocks(columns):
            self._lay(columns[:, block], even=True)
            self._forward.execute()
            found[block] = self._block[:count, : self._half].real
        return found

    def multiply(self, columns, spectrum):
        """Multiply the modes of `columns` (lines, columns) by a `spectrum`, in place."""
        half, modes = self._half, self._block
        for block, count in self._blocks(columns):
            there = self._lay(columns[:, block])
            self._forward.execute()
            part = spectrum[block]
            modes[:count, :half] *= part
            modes[:count, half:] *= _mirrored(part, half, modes.shape[1])
            self._backward.execute()
            columns[:there, block] = modes[:count, :there].T
            columns[there:, block] = 0.0

    def _lay(self, columns, even=False):
        """Copy columns to the block and fill up the period; how many lines it has room for."""
        lines, count = columns.shape
        there = min(lines, self._block.shape[1])
        self._block[:count, :there] = columns[:there].T
        self._block[:, there:] = _mirrored(self._block, there) if even else 0.0
        return there

    def _blocks(self, columns):
        return _blocks(columns.shape[1], len(self._block))


def _planned(source, target, direction):
    rows, period = len(source), max(source.shape[1], target.shape[1])
    flags = TIMED if period > LARGE and rows > 1 else FIXED
    return pyfftw.FFTW(source, target, axes=(1,), direction=direction, flags=flags, threads=THREADS)


def _lines_of_a_block(period, lines):
    return max(1, min(BLOCK // period, lines))


def _blocks(total, size):
    """(slice, its length) of one block after the other."""
    for first in range(0, total, size):
        count = min(size, total - first)
        yield slice(first, first + count), count


def _mirrored(lines, there, period=None):
    """What follows the first `there` numbers of an even period, by default as long as the `lines` are."""
    period = lines.shape[1] if period is None else period
    return lines[:, period - there : 0 : -1]
