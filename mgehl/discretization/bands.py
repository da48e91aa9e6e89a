"""Banded systems of the x-lines for the distributive line smoother."""

import numpy as np

from mgehl.discretization.kernels import REACH, build_bands, factor_bands, solve_bands
from mgehl.discretization.status import BOUNDARY, CAVITATED

STIFF = 0.3
"""A node is distributive where its mobility/dX is below this part of its own influence."""


def distributive_nodes(eps, status, dX, K00):
    """Where corrections are distributed: contact and weak Poiseuille flow; (lines, nx) bool.

    `eps` and `status` are ghosted, (lines + 2, nx). A node beside a boundary or cavitated one
    keeps its correction to itself: those pressures are given.
    """
    given = (status == BOUNDARY) | (status == CAVITATED)
    free = ~given[1:-1]
    free &= ~(given[:-2] | given[2:])
    free[:, 1:] &= ~given[1:-1, :-1]
    free[:, :-1] &= ~given[1:-1, 1:]
    return free & (eps[1:-1] < STIFF * K00 * dX)


def influence_of_columns(K):
    """Table kappa[d, l, k]: deflection k nodes along and l lines beside a column of Q.

    d = 0 is a single unit pressure, d = 1 the distributed one (1 and four times -1/4).
    `K` holds influence coefficients [l, k] for l <= 2, k <= REACH + 3.
    """
    reach = REACH + 3
    kappa = np.zeros((2, 2, reach))
    for line in (0, 1):
        for k in range(reach):
            neighbours = K[line, abs(k - 1)] + K[line, k + 1] + K[abs(line - 1), k] + K[line + 1, k]
            kappa[:, line, k] = K[line, k], K[line, k] - 0.25 * neighbours
    return kappa


class LineBands:
    """Factored banded systems of all local lines."""

    def __init__(self, lines, nx):
        self._factors = np.zeros((lines, nx, 2 * REACH + 1))

    def factor(self, linearisation, distributive, kappa):
        """Build and factor the bands of J Q for the present linearisation."""
        build_bands(linearisation.A, linearisation.B, distributive, kappa, self._factors)
        factor_bands(self._factors)

    def solve(self, r, w):
        """Solve all lines for the right-hand sides `r`; write `w`; both (lines, nx)."""
        solve_bands(self._factors, r, w)
