"""The compiled loops against numpy twins that say the same slowly."""

import numpy as np
import pytest
from dense import ALONG_X, BOTH_WAYS, dense_stencil, line_stencils

from mgehl.discretization.axes import HALO
from mgehl.discretization.kernels import apply_jacobian

every_stencil = pytest.mark.parametrize("offsets", [ALONG_X, BOTH_WAYS], ids=["along x", "both ways"])


@pytest.fixture
def rng():
    return np.random.default_rng(11)


@every_stencil
def test_apply_jacobian(offsets, rng):
    """out = A dP + B (dH + dH0) against dense matrices."""
    lines, nx = 4, 7
    A, B = line_stencils(rng, offsets, lines, nx)
    dP, dH = rng.standard_normal((2, lines + 2 * HALO, nx))
    out = np.full((lines, nx), np.nan)
    apply_jacobian(np.array(offsets), A, B, dP, dH, 0.3, out)
    expected = dense_stencil(offsets, A) @ dP.ravel() + dense_stencil(offsets, B) @ (dH + 0.3).ravel()
    np.testing.assert_allclose(out.ravel(), expected, rtol=1e-13, atol=1e-13)
