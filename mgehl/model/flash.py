"""Flash temperatures: heat that a map of friction leaves in two half-spaces that move through it.

Heat that is a time t old has moved by u t and spread by sqrt(4 kappa t). The steady rise is the integral
over all ages [Carslaw, Jaeger 1959, 10.7], of cells of even heat, summed by FFT: at any speed.
"""

from dataclasses import dataclass
from inspect import signature
from math import inf, pi, sqrt

import numpy as np
from scipy.fft import irfft2, next_fast_len, rfft2
from scipy.sparse.linalg import LinearOperator, gmres
from scipy.special import erf

GROWTH, SPREAD = 1.3, 0.3
"""Of an interval of ages at the most: ratio of its ends' square roots, and the way in its widths."""
POINTS = np.polynomial.legendre.leggauss(4)
"""In an interval of ages."""
GONE = 6.0
"""Widths behind the last node at which nothing is felt of heat any more."""
OLDEST = 1e8
"""Oldest heat, in times that it takes to spread over the map; still older heat is felt evenly."""

RELATIVE = "rtol" if "rtol" in signature(gmres).parameters else "tol"
"""What SciPy calls the relative tolerance: it has had both names, and has one."""

TOLERANCE = 1e-6
"""Relative, of the parts of the heat."""


def has_temperatures(contact):
    """Whether a contact has flash temperatures: a band of heat on a body at rest grows for ever."""
    slides, stands = contact.friction.slide_to_roll, abs(contact.friction.slide_to_roll) == 2.0
    return bool(slides) and contact.solids is not None and not (contact.is_line and stands)


@dataclass(frozen=True)
class Solid:
    """What a body makes of heat."""

    conductivity: float
    """In W/(m K)."""
    capacity: float
    """In J/(m^3 K)."""

    @property
    def diffusivity(self):
        """In m^2/s."""
        return self.conductivity / self.capacity


class MovingHeat:
    """Rise of a surface in K by heat in W/m^2, both (ny, nx), on cells of `dx` by `dy` metres. Its body
    moves by `velocity`, (u, v) in m/s, under the heat. A single line is an endless band; its body moves."""

    def __init__(self, solid, velocity, shape, dx, dy):
        self.shape = shape
        influence = _influence(solid, velocity, shape, dx, dy)
        self._padded = [next_fast_len(len_) for len_ in influence.shape]
        self._spectrum = rfft2(influence, self._padded)

    def rise(self, heat):
        """The rise by a map of heat."""
        whole = irfft2(self._spectrum * rfft2(heat, self._padded), self._padded)
        ny, nx = self.shape
        return whole[ny - 1 : 2 * ny - 1, nx - 1 : 2 * nx - 1]


def _influence(solid, velocity, shape, dx, dy):
    """Rise at all offsets from a cell that takes 1 W/m^2: (2 ny - 1, 2 nx - 1). 2/(B sqrt(pi)) times the
    integral over s = sqrt(t) of what is left of the cell along x and along y."""
    (ny, nx), kappa = shape, solid.diffusivity
    x, y = (np.arange(1 - n, n) * d for n, d in ((nx, dx), (ny, dy)))
    ends = _ages(kappa, velocity, max(x[-1], y[-1], dx), dx if ny == 1 else min(dx, dy), dx)
    if ny == 1 and velocity[0] == 0.0:
        raise ValueError("a band of heat on a body at rest has no steady temperature")
    middle, half = 0.5 * (ends[1:] + ends[:-1]), 0.5 * np.diff(ends)
    s = (middle + half * POINTS[0][:, None]).ravel()
    weights = (half * POINTS[1][:, None]).ravel()
    width = sqrt(4.0 * kappa) * s
    along = _left(x[:, None] - velocity[0] * s**2, dx, width) * weights
    across = np.ones((1, s.size)) if ny == 1 else _left(y[:, None] - velocity[1] * s**2, dy, width)
    found = across @ along.T
    if not any(velocity):
        found += dx * dy / (4.0 * pi * kappa * ends[-1])
    return 2.0 / sqrt(pi * solid.conductivity * solid.capacity) * found


def _left(distance, cell, width):
    """Part of the heat of a cell that is at a distance from its middle."""
    return 0.5 * (erf((distance + 0.5 * cell) / width) - erf((distance - 0.5 * cell) / width))


def _ages(kappa, velocity, length, cell, dx):
    """Square roots of ages, from 0 on, between which the integrand is smooth. Heat passes the edge of a
    cell along x at one of them as long as it is narrower than a cell."""
    speed, oldest = np.hypot(*velocity), OLDEST * length**2 / kappa
    past = dx / (2.0 * abs(velocity[0])) if velocity[0] else inf
    s = 0.1 * cell / sqrt(4.0 * kappa)
    if speed:
        s = min(s, 0.5 * sqrt(past if past < inf else cell / speed))
    ages = [0.0, s]
    while s**2 < oldest and speed * s**2 < 3.0 * length + GONE * sqrt(4.0 * kappa) * s:
        t = s**2
        spread = SPREAD * sqrt(4.0 * kappa * t) / speed if speed else inf
        edge = (int(t / past * (1.0 + 1e-9)) + 1) * past if past < inf else inf
        s = sqrt(min((GROWTH * s) ** 2, max(edge, t + spread)))
        ages.append(s)
    return np.array(ages)


def shared(heat, first, second, resistance):
    """Rises (first, second) of two surfaces, (ny, nx) each, that share a map of `heat` in W/m^2.

    The heat is made evenly across a film of `resistance` h/k in m^2 K/W, 0 where surfaces have one
    temperature: q_1 = q/2 - (T_1 - T_2) k/h. `first` and `second` are `MovingHeat`.
    """
    here = heat > 0.0
    if not here.any():
        return np.zeros(heat.shape), np.zeros(heat.shape)

    def whole(part):
        laid = np.zeros(heat.shape)
        laid[here] = part
        return laid

    def parted(part):
        laid = whole(part)
        return resistance[here] * part + (first.rise(laid) + second.rise(laid))[here]

    n = int(here.sum())
    right = 0.5 * (resistance * heat)[here] + second.rise(heat)[here]
    of_first, _ = gmres(LinearOperator((n, n), parted, dtype=float), right, 0.5 * heat[here], atol=0.0,
                        maxiter=200, **{RELATIVE: TOLERANCE})  # fmt: skip
    mine = whole(of_first)
    return first.rise(mine), second.rise(heat - mine)
