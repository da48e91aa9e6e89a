import numpy as np
import pytest
from dense import ALONG_X, BOTH_WAYS, dense_JQ, line_stencils

from mgehl.discretization.band_kernels import REACH
from mgehl.discretization.bands import AT_A_TIME, LineBands, influence_of_columns
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.residual import Linearisation
from mgehl.model.deformation import HalfSpace

MESH = Mesh(15, 11, (-1.9, 1.3), (-1.5, 1.5), k_e=0.6)
K = influence_coefficients(MESH, HalfSpace(0.2))
every_stencil = pytest.mark.parametrize("offsets", [ALONG_X, BOTH_WAYS], ids=["along x", "both ways"])
every_share = pytest.mark.parametrize("share", [0.25, 0.5])


@every_share
@every_stencil
def test_line_bands_solve_the_band_of_J_Q(offsets, share):
    """LineBands against numpy.linalg.solve on the dense lines of (A + B K) Q cut to the band."""
    rng = np.random.default_rng(5)
    lines, nx = AT_A_TIME + 1, MESH.nx
    A, B = line_stencils(rng, offsets, lines, nx)
    distributive = rng.random((lines, nx)) < 0.5
    distributive[:, [0, -1]] = False
    JQ = dense_JQ(offsets, A, B, K, distributive, share, REACH)
    r, w = rng.standard_normal((lines, nx)), np.empty((lines, nx))
    bands, kappa = LineBands(lines, nx), influence_of_columns(K, share)
    # A second factorisation must not see the first.
    for stencils in ((B, A), (A, B)):
        linear, given = Linearisation(np.array(offsets), *stencils, None), np.zeros((lines, nx), bool)
        diagonal = bands.factor(linear, distributive, given, kappa, share)
    np.testing.assert_allclose(diagonal, np.einsum("jiji->ji", JQ), rtol=1e-13)
    bands.solve(r, w)
    offset = np.subtract.outer(np.arange(nx), np.arange(nx))
    for j in range(lines):
        line = np.where(np.abs(offset) <= REACH, JQ[j, :, j], 0.0)
        np.testing.assert_allclose(w[j], np.linalg.solve(line, r[j]), rtol=1e-11, atol=1e-13)
