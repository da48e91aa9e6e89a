import numpy as np
import pytest
from dense import dense_K, dense_Q, dense_stencil, line_stencils

from mgehl.discretization.bands import (
    STIFF,
    LineBands,
    distributive_nodes,
    given_nodes,
    influence_of_columns,
)
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.kernels import REACH
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.residual import Linearisation
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED

MESH = Mesh(15, 11, (-1.9, 1.3), (-1.5, 1.5), k_e=0.6)
K = influence_coefficients(MESH, 0.2)


@pytest.mark.parametrize(
    "status, mobility, distributed",
    [
        (LUBRICATED, 0.99, True),
        (LUBRICATED, 1.01, False),
        (CONTACT, 0.0, True),
        (CONTACT, -1.0, True),
        (CONTACT, 50.0, True),
        (BOUNDARY, 0.0, False),
        (CAVITATED, 0.0, False),
    ],
)
def test_distributive_in_contact_and_where_poiseuille_flow_is_weak(status, mobility, distributed):
    """`mobility` in units of the threshold eps = STIFF K00 dX; given pressures never distribute."""
    dX, K00 = 0.25, 0.4
    kinds = np.full((5, 7), LUBRICATED)
    eps = np.full((5, 7), 10.0)
    kinds[2, 3], eps[2, 3] = status, mobility * STIFF * K00 * dX
    expected = np.zeros((5, 7), bool)
    expected[2, 3] = distributed
    assert (distributive_nodes(eps, kinds, dX, K00) == expected).all()


def test_given_pressures_are_those_of_boundary_and_cavity():
    status = np.array([[BOUNDARY, LUBRICATED, CAVITATED, CONTACT]])
    assert given_nodes(status).tolist() == [[True, False, True, False]]


@pytest.mark.parametrize("line", [0, 1])
@pytest.mark.parametrize("k", range(REACH + 3))
def test_influence_of_a_column_of_Q(line, k):
    """A unit pressure, and one less a quarter on each of its four neighbours."""

    def at(line, k):
        return K[abs(line), abs(k)]

    kappa = influence_of_columns(K)
    assert kappa.shape == (2, 2, REACH + 3)
    spread = at(line, k - 1) + at(line, k + 1) + at(line - 1, k) + at(line + 1, k)
    assert kappa[0, line, k] == at(line, k)
    assert kappa[1, line, k] == pytest.approx(at(line, k) - spread / 4.0, rel=1e-14)


def test_distributed_column_hardly_reaches_beyond_the_band():
    """Why corrections are distributed: the far field of (1, -1/4 ...) falls as 1/r^3, not 1/r.

    On a square mesh the column is the discrete Laplacian of 1/r, which is 1/(4 r^3) of a cell.
    """
    square = Mesh(33, 33, (-1.6, 1.6), (-1.6, 1.6))
    kappa = influence_of_columns(influence_coefficients(square, 1.0))
    single, distributed = np.abs(kappa[:, 0, -1] / kappa[:, 0, 0])
    assert distributed < 0.01 * single


def test_line_bands_solve_the_band_of_J_Q():
    """LineBands against numpy.linalg.solve on the dense lines of (A + B K) Q cut to the band."""
    rng = np.random.default_rng(5)
    lines, nx = 3, MESH.nx
    A, B = line_stencils(rng, lines, nx)
    distributive = rng.random((lines, nx)) < 0.5
    distributive[:, [0, -1]] = False
    JQ = (dense_stencil(A) + dense_stencil(B) @ dense_K(K, lines + 2, nx)) @ dense_Q(distributive)
    JQ = JQ.reshape(lines, nx, lines, nx)
    r, w = rng.standard_normal((lines, nx)), np.empty((lines, nx))
    bands = LineBands(lines, nx)
    # A second factorisation must not see the first.
    for stencils in ((B, A), (A, B)):
        bands.factor(Linearisation(*stencils), distributive, influence_of_columns(K))
    bands.solve(r, w)
    offset = np.subtract.outer(np.arange(nx), np.arange(nx))
    for j in range(lines):
        line = np.where(np.abs(offset) <= REACH, JQ[j, :, j], 0.0)
        np.testing.assert_allclose(w[j], np.linalg.solve(line, r[j]), rtol=1e-11, atol=1e-13)
