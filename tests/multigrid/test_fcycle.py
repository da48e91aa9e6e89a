"""The cycle: how often it visits a grid, and what a second visit adds."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import mgehl
from mgehl.multigrid.fcycle import SECOND, FCycle

NODES = 5
THICK = Path(__file__).parents[2] / "configs" / "moes_20_10.toml"


class DenseGrid:
    """A Jacobian A + B K with its border, of dense random matrices; it returns its buffers, as the real one
    does."""

    rigid = False

    def __init__(self, rng, load_scale):
        self.load_scale = load_scale
        self._A, self._B, self._K = np.eye(NODES) * 4.0 + rng.random((3, NODES, NODES))
        self._dH, self._product = np.empty((2, NODES))
        self.space = SimpleNamespace(
            read_own=lambda x: (x[:-1], x[-1]), write=self._write, border_in_team=lambda H0: H0
        )

    @property
    def matrix(self):
        """J with its border."""
        J = self._A + self._B @ self._K
        weights = np.full((1, NODES), self.load_scale)
        return np.block([[J, self._B.sum(axis=1, keepdims=True)], [weights, np.zeros((1, 1))]])

    def _write(self, y, P, H0):
        y[:-1], y[-1] = P, H0

    def deflection(self, P):
        return np.matmul(self._K, P, out=self._dH)

    def product(self, dP, dH, dH0):
        self._product[:] = self._A @ dP + self._B @ (dH + dH0)
        return self._product

    def load_of(self, dP):
        return self.load_scale * dP.sum()


class Damping:
    """A smoother, c = S r, that returns its buffer; on the finest grid of none, to show what the grid below
    did."""

    relaxations = 1

    def __init__(self, S, sees_cliffs=False):
        self._S, self._out, self.sees_cliffs = S, np.empty(NODES), sees_cliffs

    def relax(self, r):
        return np.matmul(self._S, r, out=self._out)


class Direct:
    """The solve on the coarsest grid."""

    def __init__(self, matrix):
        self._inverse = np.linalg.inv(matrix)

    def solve(self, r, load):
        x = self._inverse @ np.append(r, load)
        return x[:-1], x[-1]


@pytest.fixture
def make_cycle():
    """Function: dense matrix of a cycle on three grids of as many nodes, and the middle one's Jacobian."""
    rng = np.random.default_rng(5)
    grids = [DenseGrid(rng, scale) for scale in (3.0, 2.0, 2.0)]
    S, R, P = 0.1 * rng.random((NODES, NODES)), *rng.random((2, NODES, NODES))
    between = SimpleNamespace(restrict=R.dot, prolong=P.dot, bilinear=P.dot)
    same = SimpleNamespace(restrict=np.copy, prolong=np.copy, bilinear=np.copy)

    def make(sees_cliffs, sweeps):
        smoothers = [Damping(S, sees_cliffs), Damping(np.zeros_like(S))]
        cycle = FCycle(grids, [between, same], smoothers, Direct(grids[0].matrix), sweeps)
        matrix = np.empty((NODES + 1,) * 2)
        for x, y in zip(np.eye(NODES + 1), matrix.T, strict=True):
            cycle.apply(None, x, y)
        return matrix, grids[1].matrix

    return make


@pytest.mark.parametrize("sweeps", [1, 2])
def test_the_second_visit_takes_its_share_of_what_the_first_one_left(make_cycle, sweeps):
    """I - J F = (I - theta J V) (I - J V), border included."""
    V, J = make_cycle(False, sweeps)
    F, _ = make_cycle(True, sweeps)
    left = np.eye(NODES + 1) - J @ V
    expected = (np.eye(NODES + 1) - SECOND * J @ V) @ left
    np.testing.assert_allclose(np.eye(NODES + 1) - J @ F, expected, rtol=1e-10, atol=1e-10)
    assert np.abs(F - V).max() > 1e-2


def test_gmres_iterations_of_a_thick_film_do_not_grow_with_the_grid():
    """M = 20, L = 10 by the linear gap: with V-cycles up to 2, 3, 3 and 4 on 129 to 1025 nodes."""
    most = []
    for nodes in (129, 257, 513):
        settings = {"solver.error": False, "grid.nodes": nodes}
        settings |= {"discretization.couette": "3B", "discretization.face_mobility": "linear-gap"}
        solution = mgehl.solve(mgehl.load(THICK, settings), speak=False)
        assert solution.result.converged
        most.append(max(row["linear_iterations"] for row in solution.rows if row["grid"] == nodes))
    assert most == [2, 2, 2]
