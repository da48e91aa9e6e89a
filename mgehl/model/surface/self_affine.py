"""A random surface whose spectrum is a power law: self-affine, as ground and shot surfaces are.

Waves of a square lattice have known amplitudes and random phases: heights at any point and the rms over a
period are exact, whatever the grid; on a grid's nodes two products of matrices sum them.
"""

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from math import pi

import numpy as np

from mgehl.model.frame import direction
from mgehl.model.surface.smoothing import lines_of
from mgehl.model.surface.surface import JUST, Surface
from mgehl.model.surface.waviness import seen

PERIODS = 4
"""Longest waves in the period after which the surface repeats itself."""

LARGEST_SPAN = 256.0
"""Of the longest wavelength over the shortest: the lattice has some 2000 by 1000 waves then."""

BLOCK = 2**20
"""Points times waves of one axis that are summed at a time where points are no grid's."""


@dataclass(frozen=True)
class SelfAffine(Surface):
    """Power spectral density q^(-2 - 2 H) between two wavelengths, and nothing beyond them."""

    rms: float
    """In m, over a period."""
    shortest_wavelength: float
    longest_wavelength: float
    hurst: float = 0.8
    """H: 1 is smooth in the small, 0 the same at every length."""
    seed: int = 0
    aspect: float = 1.0
    """Length of a feature along `angle` over that across it, which the wavelengths are of."""
    angle: float = 0.0
    x: float = 0.0
    """Where the surface's origin is, in m."""
    y: float = 0.0
    cut_off: tuple = (0.0, 0.0)
    """Wavelengths in m along x and y below which waves are left out."""

    @property
    def period(self):
        """Along x and along y, in m."""
        return PERIODS * self.aspect * self.longest_wavelength

    def height(self, x, y):
        """The sum of all waves; on a grid's nodes by products of matrices."""
        x, y = np.subtract(x, self.x), np.subtract(y, self.y)
        shape, lines = np.broadcast_shapes(x.shape, y.shape), lines_of(x, y)
        if lines is None:
            return self._at_points(*(each.ravel() for each in np.broadcast_arrays(x, y))).reshape(shape)
        x, y, turned = lines
        found = self._on_grid(x, y)
        return (found.T if turned else found).reshape(shape)

    def shortest(self, x, y):
        """As it was asked for."""
        return self.shortest_wavelength

    def filtered(self, wavelengths, x, y):
        """Exactly."""
        return replace(self, cut_off=tuple(map(max, self.cut_off, wavelengths)))

    @cached_property
    def _waves(self):
        """Wave numbers along x (m,) and along y (n,), and the complex amplitudes (n, m)."""
        m, n, amplitudes = lattice(
            self.rms, self.shortest_wavelength / self.period, self.longest_wavelength / self.period,
            self.hurst, self.seed, self.aspect, self.angle,
        )  # fmt: skip
        p, q = 2.0 * pi / self.period * m, 2.0 * pi / self.period * n
        return p, q, np.where(seen((p[None, :], q[:, None]), self.cut_off), amplitudes, 0.0)

    def _on_grid(self, x, y):
        """Heights (ny, nx)."""
        p, q, amplitudes = self._waves
        along_y = np.exp(1j * np.outer(y, q)) @ amplitudes
        phase = np.outer(p, x)
        # Products of parts that lie apart in memory would take ten times as long.
        real, imaginary = np.ascontiguousarray(along_y.real), np.ascontiguousarray(along_y.imag)
        return real @ np.cos(phase) - imaginary @ np.sin(phase)

    def _at_points(self, x, y):
        """Heights of points (k,)."""
        p, q, amplitudes = self._waves
        found, step = np.empty(len(x)), max(1, BLOCK // len(p))
        for first in range(0, len(x), step):
            part = slice(first, first + step)
            along_y = np.exp(1j * np.outer(y[part], q)) @ amplitudes
            found[part] = (along_y * np.exp(1j * np.outer(x[part], p))).sum(axis=1).real
        return found


@lru_cache(maxsize=4)
def lattice(rms, shortest, longest, hurst, seed, aspect, angle):
    """Numbers of waves in a period along x (m,), along y (n,), and amplitudes (n, m), of one of k and -k.

    `shortest` and `longest` are parts of the period. Phases are drawn from the longest wave on, so that a
    shorter cut-off keeps the long waves. Amplitudes squared add up to 2 rms^2.
    """
    most = int((1.0 + JUST) / shortest)
    m, n = np.arange(-most, most + 1), np.arange(most + 1)
    q = _stretched(m[None, :], n[:, None], aspect, angle)
    inside = (q * longest >= 1.0 - JUST) & (q * shortest <= 1.0 + JUST)
    inside[0, : most + 1] = False  # waves along x: k and -k are in the same row
    power = np.where(inside, np.where(inside, q, 1.0) ** (-2.0 - 2.0 * hurst), 0.0)
    sizes = rms * np.sqrt(2.0 * power / power.sum())
    return m, n, sizes * np.exp(2j * pi * _turns(m, n, seed))


def _stretched(m, n, aspect, angle):
    """Size of a wave vector (m, n), its part along `angle` times `aspect`."""
    c, s = direction(angle)
    return np.hypot(aspect * (c * m + s * n), c * n - s * m)


def _turns(m, n, seed):
    """Random phases (n, m), in turns, drawn in the order of the lengths of the wave vectors."""
    rows, columns = (each.ravel() for each in np.broadcast_arrays(n[:, None], m[None, :]))
    order = np.lexsort((columns, rows, rows**2 + columns**2))
    turns = np.empty(len(order))
    turns[order] = np.random.Generator(np.random.PCG64(seed)).random(len(order))
    return turns.reshape(len(n), len(m))
