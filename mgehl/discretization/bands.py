"""Banded systems of the x-lines for the distributive line smoother."""

from itertools import pairwise

import numpy as np

from mgehl.discretization.band_kernels import (
    REACH,
    build_bands,
    empty_columns,
    factor_lines,
    solve_lines,
    span_of,
)
from mgehl.discretization.rows import GAP, PRESSURE

STIFF = 0.3
"""A node is distributive where its mobility/dX is below this part of its influence; 0.09 to 0.9 do."""

AT_A_TIME = 4
"""Lines that are filled and factored before the next ones: a fifth less time than all at once."""

LINES_BESIDE = 2
"""Lines on each side that a stencil couples a line to."""


def distributive_nodes(eps, rows, dX, K00, is_line=False):
    """Where corrections are distributed: contact and weak Poiseuille flow; all (lines, nx). What such a
    node would hand to a given one is dropped: keeping it leaves modes that the band of K amplifies.

    In a line contact, whose influence falls like a logarithm, every node is one: beside stiff nodes others
    leave such modes, too. On 4097 nodes of soft bodies they made a correction of 1e12 residuals.
    """
    stiff = is_line | (eps < STIFF * K00 * dX)
    return (stiff | (rows == GAP)) & (rows != PRESSURE)


def influence_of_neighbours(K, line, node):
    """Of a node's four neighbours together."""
    return K[line, abs(node - 1)] + K[line, node + 1] + K[abs(line - 1), node] + K[line + 1, node]


def influence_of_columns(K, share):
    """Table kappa[d, l, k]: deflection k nodes along and l lines beside a column of Q.

    d = 0 is a single unit pressure, d = 1 the distributed one (1, and -`share` at its neighbours). `K`
    holds influence coefficients [l, k] for l <= LINES_BESIDE + 1, k <= REACH + 1. Beyond REACH the table
    keeps its last value: bands difference it, and a sum that is left would act as a source whose solution
    grows as exp(c nx). (Rows of 2B reach one node further and keep a thousandth of their diagonal.)
    """
    kappa = np.zeros((2, LINES_BESIDE + 1, REACH + 3))
    for line in range(LINES_BESIDE + 1):
        for k in range(REACH + 1):
            kappa[:, line, k] = K[line, k], K[line, k] - share * influence_of_neighbours(K, line, k)
    kappa[:, :, REACH + 1 :] = kappa[:, :, REACH : REACH + 1]
    return kappa


class LineBands:
    """Factored banded systems of all local lines, each node coupled to `REACH` on each side. A line's
    system has the nodes of its span alone (`span_of`). A few lines have a span together, by their numbers
    on the whole grid, of which `before` come before these: so spans are the same on any number of ranks."""

    def __init__(self, lines, nx, before=0):
        self._shape, self._factors = (lines, nx, 2 * REACH + 1), None
        self._spans, self._before = np.tile([0, nx], (lines, 1)), before

    def factor(self, linearisation, distributive, given, kappa, share, contents=None):
        """Factor what J Q couples along the lines; return its diagonal, (lines, nx), zero beyond the spans;
        a few lines at a time, for the cache. Unknowns of `contents`, a mask, deflect nothing."""
        lin, bands, spans = linearisation, self._room(), self._spans
        diagonal = np.zeros(bands.shape[:2])
        for some in self._groups(AT_A_TIME):
            few = some.start, some.stop
            spans[some] = nodes = span_of(given, few)
            build_bands(lin.offsets, lin.A, lin.B, distributive, kappa, share, bands, few, nodes)
            if contents is not None and contents[some].any():
                empty_columns(bands[some], contents[some])
                for (beside, ahead), by_content in lin.carried.items():
                    if beside == 0:
                        here = some, slice(*nodes)  # beyond it there is nothing yet
                        bands[*here, bands.shape[2] // 2 + ahead] += by_content[here]
            diagonal[some, slice(*nodes)] = bands[some, slice(*nodes), REACH]
            factor_lines(bands[some], nodes)
        return diagonal

    def _groups(self, size):
        """Slices of so many lines; the first and the last may have fewer."""
        lines = self._shape[0]
        ends = [0, *range(size - self._before % size, lines, size), lines]
        return [slice(*pair) for pair in pairwise(ends)]

    def _room(self):
        """The array of the bands, whatever is in it."""
        if self._factors is None:
            self._factors = np.empty(self._shape)
        return self._factors

    def forget(self):
        """Free the memory of the bands."""
        self._factors = None

    def solve(self, r, w):
        """Solve all lines for the right-hand sides `r`; write `w`, which may be `r`; both (lines, nx)."""
        solve_lines(self._factors, self._spans, r, w)
