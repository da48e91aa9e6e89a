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
    """A Jacobian A + B K with its border, of dense random matrices."""

    rigid, load_scale = False, 1.0

    def __init__(self, rng, holds_film):
        self.holds_film = holds_film
        self._A, self._B, self._K = np.eye(NODES) * 4.0 + rng.random((3, NODES, NODES))
        self.space = SimpleNamespace(
            read_own=lambda x: (x[:-1], x[-1]),
            write=lambda y, P, H0: y.__setitem__(slice(None), np.append(P, H0)),
            border_in_team=lambda H0: H0,
        )

    @property
    def matrix(self):
        """J with its border."""
        J = self._A + self._B @ self._K
        return np.block([[J, self._B.sum(axis=1, keepdims=True)], [np.ones((1, NODES)), np.zeros((1, 1))]])

    def deflection(self, P):
        return self._K @ P

    def product(self, dP, dH, dH0):
        return self._A @ dP + self._B @ (dH + dH0)

    def load_of(self, dP):
        return dP.sum()


class Damping:
    """A smoother, c = S r; on the finest grid of none, to show what the grid below did."""

    visits = 1

    def __init__(self, S, sees_cliffs=False):
        self._S, self.sees_cliffs = S, sees_cliffs

    def relax(self, r):
        return self._S @ r


@pytest.fixture
def make_cycle():
    """Function: dense matrix of a cycle on three grids of as many nodes, and the middle one's Jacobian."""
    rng = np.random.default_rng(5)
    grids = [DenseGrid(rng, holds) for holds in (False, True, True)]
    S, R, P = 0.1 * rng.random((NODES, NODES)), *rng.random((2, NODES, NODES))
    between = SimpleNamespace(restrict=R.dot, prolong=P.dot, bilinear=P.dot)
    same = SimpleNamespace(restrict=np.copy, prolong=np.copy, bilinear=np.copy)
    inverse = np.linalg.inv(grids[0].matrix)
    coarse = SimpleNamespace(
        solve=lambda r, load: (lambda x: (x[:-1], x[-1]))(inverse @ np.append(r, load))
    )

    def make(sees_cliffs):
        smoothers = [Damping(S, sees_cliffs), Damping(np.zeros_like(S))]
        cycle = FCycle(grids, [between, same], smoothers, coarse, sweeps=1)
        matrix = np.empty((NODES + 1,) * 2)
        for x, y in zip(np.eye(NODES + 1), matrix.T, strict=True):
            cycle.apply(None, x, y)
        return matrix, grids[1].matrix

    return make


def test_the_second_visit_takes_its_share_of_what_the_first_one_left(make_cycle):
    """I - J F = (I - theta J V) (I - J V), border included."""
    V, J = make_cycle(sees_cliffs=False)
    F, _ = make_cycle(sees_cliffs=True)
    left = np.eye(NODES + 1) - J @ V
    np.testing.assert_allclose(
        np.eye(NODES + 1) - J @ F, (np.eye(NODES + 1) - SECOND * J @ V) @ left, rtol=1e-10, atol=1e-10
    )
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
