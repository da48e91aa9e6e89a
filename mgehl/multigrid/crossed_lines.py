"""The distributive line smoother with lines along both axes."""

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.band_kernels import REACH
from mgehl.discretization.bands import STIFF, LineBands, influence_of_columns
from mgehl.grid.events import LINES, event
from mgehl.grid.transpose import YLines, pieces_of_y_lines
from mgehl.multigrid.smoother import LineSmoother, influence_nearby

CLIFF = 1000.0
"""Ratio of the mobilities of neighbours from which on it counts as a cliff. Thin films have none."""


class CrossedLineSmoother(LineSmoother):
    """The same with lines along both axes: c = omega Q (X D^-1 Y)^-1 r.

    X and Y are the parts of J Q along the x-lines and along the y-lines, D their diagonal: the product is J
    Q but for what couples both. Lines along one axis alone leave waves across the motion, the more the
    finer the grid; the product damps these, too (M = 20, L = 10 by 2B on 257 nodes: 3 iterations of GMRES
    at the most for 6). A relaxation goes along X first and then along Y, the next one the other way round.
    """

    def __init__(self, jacobian, omega):
        super().__init__(jacobian, omega)
        grid = jacobian.grid
        self._y_kappa = influence_of_columns(influence_nearby(jacobian, turned=True), self._share)
        self._y_lines = YLines(grid) if grid.has_lines else None
        if self._y_lines:
            self._y_bands = LineBands(*self._y_lines.shape)

    def free(self):
        """Free the MPI datatypes."""
        if self._y_lines:
            self._y_lines.destroy()

    def forget(self):
        """Free the memory of the factors."""
        super().forget()
        if self._y_lines:
            self._y_bands.forget()

    @event(LINES)
    def factor(self):
        """Factor the bands of the present linearisation; the next relaxation begins along X."""
        self._along_y_first = False
        if not self._y_lines:
            return
        self._build_x_lines()
        self._diagonal = self._bands.diagonal.copy()
        self._bands.factor()
        for lines, some in pieces_of_y_lines(self._jacobian.grid):
            lin, distributive = self._jacobian.linearisation, own(self._distributive)
            turned = lin.turned(some.turned), some.turned(distributive) > 0.0
            self._y_bands.build(*turned, self._y_kappa, self._share, lines)
        self._y_bands.factor()

    def _solve_lines(self, r):
        """Solve along one axis, then along the other; the next time in the other order."""
        if not self._y_lines:
            return
        if self._along_y_first:
            self._solve_y_lines(r)
            self._w *= self._diagonal
            self._bands.solve(self._w, self._w)
        else:
            self._bands.solve(r, self._w)
            self._w *= self._diagonal
            self._solve_y_lines(self._w)
        self._along_y_first = not self._along_y_first

    def _solve_y_lines(self, r):
        w = self._y_lines.turned(r)
        self._y_bands.solve(w, w)
        self._y_lines.turn_back(w, self._w)

    def view(self, viewer):
        words = f"omega {self._omega}, {REACH} neighbours"
        viewer.printfASCII(f"  distributive Jacobi along x- and y-lines, {words}\n")


class CliffSmoother(CrossedLineSmoother):
    """The same, but along X alone and as of a `RoughLineSmoother` where the mobility has cliffs.

    The mobile node of a cliff acts on the other one, which hardly acts back. The product of lines that
    cross is a poor approximation of that, most of all in the first steps on a grid. Thick films have cliffs
    at their pressure spike. M = 200, L = 10 by 3B on 1025 nodes takes 131 convolutions for 448 by the
    linear gap, and 96 for 123 by the arithmetic mean.
    """

    def partition(self, rows):
        """As of a `LineSmoother`; ask whether there are cliffs."""
        super().partition(rows)
        jacobian = self._jacobian
        driven = STIFF * self._K00 * jacobian.grid.mesh.dX
        found = cliffs(jacobian.linearisation.eps, driven) if jacobian.grid.has_lines else 0
        self._has_cliffs = jacobian.grid.sum_of_team(found) > 0
        self.hands_over_everywhere = not self._has_cliffs

    @event(LINES)
    def factor(self):
        """Factor what the next relaxation needs."""
        if self._has_cliffs:
            self._build_x_lines()
            self._bands.factor()
        else:
            super().factor()

    def _solve_lines(self, r):
        if self._has_cliffs:
            self._bands.solve(r, self._w)
        else:
            super()._solve_lines(r)


def cliffs(eps, driven):
    """How many neighbours on x-lines differ by `CLIFF`, one of them more mobile than `driven`."""
    high, low = np.maximum(eps[:, 1:], eps[:, :-1]), np.minimum(eps[:, 1:], eps[:, :-1])
    return np.count_nonzero((high > driven) & (low * CLIFF < high))
