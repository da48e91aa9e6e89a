"""The slider of Bertocchi et al. in one dimension, by finite volumes that use nothing of mgehl.

[Bertocchi, Dini, Giacopini, Fowell and Baldini, Tribology International 67 (2013)]. Film: the flow
rho h U/2 - rho h^3/(12 eta) dp/dx is the same everywhere, and p >= 0. Cavity: p = 0, and oil fills a part
theta <= 1 of the gap, with the flow theta h U/2. So one of p and 1 - theta is nothing everywhere, and one
unknown is enough for a cell: z is p over a pressure of the film, and in a cavity theta - 1.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.linalg import solve_banded

from mgehl.config import load_config
from mgehl.output.centre_line import centre_pressure
from mgehl.studies.study import BEST, merged

FILE = Path(__file__).parents[2] / "configs" / "pocket.toml"

LENGTH, INLET_FILM, EXIT_FILM = 20e-3, 1.1e-6, 1.0e-6
POCKET, DEPTH = (4e-3, 10e-3), 0.4e-6
SPEED = 1.0
"""Of the one surface that moves."""
VISCOSITY, PRESSURE_VISCOSITY = 0.01, 12e-9
AMBIENT = 1e5
C1, C2 = 2.22e9, 1.66
"""Of Dowson and Higginson's density."""
SIZES = {"small": (10e-3, 7e-3), "large": (300e-3, 210e-3)}
"""Widths of pad and pocket in m, of the sliders of finite width."""
SCALE = 6.0 * VISCOSITY * SPEED * LENGTH / EXIT_FILM**2
"""Pa, of z."""

CELLS = 10000
STEPS = 200
CLOSED = 1e-11
"""Difference of the flows through a cell's faces, over the largest flow, that ends the iteration."""
DIFFERENCE = 1e-7
"""Of z, for derivatives."""
BEGUN = 1e-15
"""Size of z where a film has just torn, or a cavity has just been filled."""


def density_at(p):
    return (C1 + C2 * p) / (C1 + p), (C2 - 1.0) * C1 / (C1 + p) ** 2


def film(x):
    """The gap at x, counted from the inlet along the motion."""
    in_pocket = (x > POCKET[0]) & (x < POCKET[1])
    return INLET_FILM + (EXIT_FILM - INLET_FILM) * x / LENGTH + DEPTH * in_pocket


@dataclass(frozen=True)
class Answer:
    """At the middles `x` of the cells, in SI."""

    x: np.ndarray
    p: np.ndarray
    theta: np.ndarray
    flow: np.ndarray
    """The oil at p = 0 that flows through each face, in m^2/s."""

    @property
    def cavity(self):
        """The first and the last x without pressure."""
        return tuple(self.x[self.p == 0.0][[0, -1]])


def solve(cells=CELLS):
    """The `Answer` on a multiple of 10 cells: then the pocket's edges are faces. Raises RuntimeError."""
    x = LENGTH / cells * (np.arange(cells) + 0.5)
    z = np.full(cells, AMBIENT / SCALE)
    for _ in range(STEPS):
        flow = _flow(x, z)
        left = np.diff(flow)
        if np.abs(left).max() <= CLOSED * np.abs(flow).max():
            return Answer(x, SCALE * np.maximum(z, 0.0), 1.0 + np.minimum(z, 0.0), flow)
        new = np.maximum(z - solve_banded((1, 1), _derivatives(x, z, left), left), -1.0)
        z = np.where(new * z < 0.0, np.copysign(BEGUN, new), new)
    raise RuntimeError(f"no balance after {STEPS} steps")


def _derivatives(x, z, left):
    """The three bands of the derivatives of `left` by z: a cell's flows know its two neighbours alone."""
    bands, cells = np.zeros((3, x.size)), np.arange(x.size)
    for colour in range(3):
        columns = cells[colour::3]
        step = np.where(cells % 3 == colour, np.copysign(DIFFERENCE, z), 0.0)
        change = np.pad(np.diff(_flow(x, z + step)) - left, 1)
        for band in range(3):
            bands[band, columns] = change[columns + band] / step[columns]
    return bands


def _flow(x, z):
    """The oil that flows through the faces, (cells + 1,), in m^2/s.

    The halves of cells on both sides of a face have their own gaps, one behind the other: so a step of the
    gap at a face is no error. Beyond the ends there is no half.
    """
    dx = LENGTH / x.size
    p = SCALE * np.pad(np.maximum(z, 0.0), 1, constant_values=AMBIENT / SCALE)
    theta, (rho, _) = np.append(1.0, 1.0 + np.minimum(z, 0.0)), density_at(p)
    eta = VISCOSITY * np.exp(PRESSURE_VISCOSITY * p)
    halves = np.append(np.inf, film(x + 0.25 * dx)), np.append(film(x - 0.25 * dx), np.inf)
    resistances = [3.0 * dx / gap**3 * (eta[:-1] + eta[1:]) for gap in halves]
    dragged = sum(0.5 * SPEED * 3.0 * dx / gap**2 * (eta[:-1] + eta[1:]) for gap in halves)
    pressed = 0.5 * (rho[:-1] + rho[1:]) * np.diff(p)
    return (theta * rho[:-1] * dragged - pressed) / sum(resistances)


def case(nodes, couette="3B", size=None):
    """The tables of mgehl's slider; without a `size` nothing varies across the motion."""
    pad, pocket = SIZES.get(size, (None, None))
    wide = {"width": pad, "sides": "open", "pocket_width": pocket} if size else {}
    own = {"wedge": wide, "grid": {"nodes": nodes}, "discretization": BEST | {"couette": couette}}
    return merged(load_config(FILE).as_toml_tables(), own)


def pressures(solution):
    """x in m and the pressure in Pa on the centre line."""
    X, P = centre_pressure(solution.mesh, solution.fields)
    return X * solution.contact.x_scale, P * solution.contact.pressure_scale


def difference(solution, answer):
    """The largest difference to an `Answer` at any node, over its largest pressure."""
    x, p = pressures(solution)
    beside = np.interp(x, np.pad(answer.x, 1, constant_values=(0.0, LENGTH)),
                       np.pad(answer.p, 1, constant_values=AMBIENT))  # fmt: skip
    return np.abs(p - beside).max() / answer.p.max()
