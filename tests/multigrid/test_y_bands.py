import numpy as np
import pytest

from mgehl.discretization.bands import LineBands, influence_of_columns
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.residual import Linearisation
from mgehl.model.deformation import HalfSpace
from mgehl.multigrid.y_bands import YBands

NX, NY, SHARE = 15, 21, 0.25
OFFSETS = np.array([(0, 0), (0, -1), (0, 1), (-1, 0), (1, 0)])


@pytest.fixture
def grid(make_grid):
    return make_grid(Mesh(NX, NY, (-1.9, 1.3), (-1.5, 1.5)))


@pytest.fixture
def kappa(grid):
    K = influence_coefficients(grid.mesh, HalfSpace(0.2))
    return influence_of_columns(np.ascontiguousarray(K.T), SHARE)


@pytest.fixture
def y_bands(grid, kappa):
    made = YBands(grid, kappa, SHARE)
    yield made
    made.forget()


@pytest.fixture
def rng():
    return np.random.default_rng(3)


def system(rng):
    """Linearisation, distributive nodes, given nodes: a given frame and a given corner."""
    A, B = rng.standard_normal((2, len(OFFSETS), NY, NX))
    A[0] += 12.0
    given = np.ones((NY, NX), bool)
    given[2:-2, 1:-1] = False
    given[: NY // 2, NX // 2 :] = True
    A[1:, given], B[:, given] = 0.0, 0.0
    distributive = (rng.random((NY, NX)) < 0.5) & ~given
    return Linearisation(OFFSETS, A, B, None), distributive, given


def turned(linearisation):
    A, B = (np.ascontiguousarray(each.transpose(0, 2, 1)) for each in (linearisation.A, linearisation.B))
    return Linearisation(np.ascontiguousarray(OFFSETS[:, ::-1]), A, B, None)


def test_y_lines_are_solved_as_the_x_lines_of_the_turned_plane(y_bands, kappa, rng):
    linearisation, distributive, given = system(rng)
    r, w = np.where(given, 0.0, rng.standard_normal((NY, NX))), np.empty((NY, NX))
    y_bands.factor(linearisation, distributive, given)
    y_bands.solve(r, w)
    lines, expected = LineBands(NX, NY), np.empty((NX, NY))
    lines.factor(turned(linearisation), distributive.T.copy(), given.T.copy(), kappa, SHARE)
    lines.solve(r.T.copy(), expected)
    np.testing.assert_allclose(w, expected.T, rtol=1e-11, atol=1e-13)
    assert w.any()
