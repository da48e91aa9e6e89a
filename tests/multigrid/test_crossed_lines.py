"""The smoother with lines along both axes."""

import numpy as np
import pytest

from mgehl.discretization.band_kernels import span_of
from mgehl.discretization.bands import AT_A_TIME, distributive_nodes
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.rows import FLOW, GAP, PRESSURE
from mgehl.discretization.scheme import Scheme
from mgehl.multigrid.crossed_lines import CrossedLineSmoother

OMEGA = 0.8


class TestLinesAlongBothAxes:
    """Of a motion at an angle, against dense matrices, on a grid that a band spans.

    A band is cut at 4 nodes, and the ends of a line are 5 apart: they and what is beside them are given, so
    that nothing moves there. Four lines along X have a span together; beyond spans w is zero.
    """

    NODES = 6

    @pytest.fixture
    def jacobian(self, make_problem, paper_contact, rough_state, make_jacobian):
        contact = paper_contact(radius_y=20e-3, angle=30.0)
        problem = make_problem(contact, Scheme("2B", motion=contact.motion), nodes=self.NODES)
        return make_jacobian(problem, rough_state(problem))

    @pytest.fixture
    def rows(self):
        """Nodes that are distributive in the middle but for one; the pressures about them are given."""
        rows = np.full((self.NODES, self.NODES), PRESSURE)
        rows[2:-2, 2:-2] = FLOW
        rows[2, 3], rows[3, 2] = GAP, PRESSURE
        return rows

    @pytest.fixture
    def smoother(self, jacobian, rows, make_smoother):
        jacobian.given = rows == PRESSURE
        return make_smoother(jacobian, rows, CrossedLineSmoother)

    def parts(self, jacobian, rows, make_vec):
        """Q, and the parts of J Q along the x-lines, along the y-lines and on the diagonal."""
        n, K = self.NODES, influence_coefficients(jacobian.grid.mesh, jacobian.contact.kernel)
        distributive = distributive_nodes(jacobian.linearisation.eps, rows, jacobian.grid.mesh.dX, K[0, 0])
        assert distributive.any()
        Q = np.eye(n * n).reshape(n, n, n, n)
        for j, i in np.argwhere(distributive):
            for line, node in ((j - 1, i), (j + 1, i), (j, i - 1), (j, i + 1)):
                Q[line, node, j, i] = -0.25
        JQ, out = np.empty_like(Q), make_vec(jacobian.space)
        for j, i in np.ndindex(n, n):
            jacobian.mat.mult(make_vec(jacobian.space, Q[:, :, j, i]), out)
            JQ[:, :, j, i] = jacobian.space.read(out)[0]
        same = np.eye(n, dtype=bool)
        of_line, of_column = same[:, None, :, None], same[None, :, None, :]
        X, Y, D = (np.where(kept, JQ, 0.0) for kept in (of_line, of_column, of_line & of_column))
        return (each.reshape(n * n, n * n) for each in (Q, X, Y, D))

    def in_x_spans(self, rows):
        """The nodes that the systems of lines along X have, of these rows."""
        inside = np.zeros(rows.shape, bool)
        for first in range(0, len(rows), AT_A_TIME):
            lines = slice(first, min(first + AT_A_TIME, len(rows)))
            inside[lines, slice(*span_of(rows == PRESSURE, (lines.start, lines.stop)))] = True
        assert inside.any() and not inside.all()
        return inside

    def in_y_spans(self, rows):
        """Those of lines along Y: between the outermost nodes that move there or on a line beside."""
        moves = rows != PRESSURE
        beside = moves.copy()
        beside[1:] |= moves[:-1]
        beside[:-1] |= moves[1:]
        nodes = np.arange(rows.shape[1])
        first, end = beside.argmax(axis=1), rows.shape[1] - beside[:, ::-1].argmax(axis=1)
        inside = beside.any(axis=1)[:, None] & (nodes >= first[:, None]) & (nodes < end[:, None])
        assert inside.any() and not inside.all()
        return inside

    @staticmethod
    def solved(matrix, inside, r):
        """Solution of the equations of the nodes `inside`, where the others are zero."""
        own, w = np.flatnonzero(inside), np.zeros(r.shape)
        w[own] = np.linalg.solve(matrix[np.ix_(own, own)], r[own])
        return w

    def test_first_along_x_and_then_along_y_and_the_next_time_the_other_way_round(
        self, smoother, jacobian, rows, make_vec
    ):
        Q, X, Y, D = self.parts(jacobian, rows, make_vec)
        r = np.random.default_rng(8).standard_normal((self.NODES, self.NODES))
        r[[0, -1]], r[:, [0, -1]] = 0.0, 0.0
        along_x, along_y = (X, self.in_x_spans(rows)), (Y, self.in_y_spans(rows))
        for first, then in ((along_x, along_y), (along_y, along_x), (along_x, along_y)):
            correction = smoother.relax(r)
            w = self.solved(*then, np.diag(D) * self.solved(*first, r.ravel()))
            expected = np.where(rows == PRESSURE, 0.0, OMEGA * (Q @ w).reshape(r.shape))
            np.testing.assert_allclose(correction, expected, rtol=1e-9, atol=1e-11 * np.abs(expected).max())

    def test_new_rows_begin_along_x_again(self, smoother):
        """A factorisation must not depend on how many relaxations came before it."""
        corrections = []
        for _ in range(2):
            smoother.factor()
            corrections.append(smoother.relax(np.ones((self.NODES, self.NODES))).copy())
        np.testing.assert_array_equal(*corrections)
