"""The compiled means of mobilities against numpy twins that say the same slowly."""

import numpy as np
import pytest

from mgehl.discretization.mean_kernels import linear_gap_means, logarithmic_means


@pytest.fixture
def rng():
    return np.random.default_rng(11)


class TestLogarithmicMeans:
    @staticmethod
    def found(a, b):
        parts = np.full((3, *a.shape), np.nan)
        logarithmic_means(a, b, *parts)
        return parts

    def test_of_mobilities_that_differ(self, rng):
        """m = (a - b)/ln(a/b), dm/da = (1 - m/a)/ln(a/b), along lines that are views of a larger array."""
        a, b = np.exp(rng.uniform(-30.0, 30.0, (2, 4, 14)))[:, :, ::2]
        logarithm = np.log(a / b)
        mean = (a - b) / logarithm
        for part, twin in zip(
            self.found(a, b),
            (mean, (1.0 - mean / a) / logarithm, (mean / b - 1.0) / logarithm),
            strict=True,
        ):
            np.testing.assert_allclose(part, twin, rtol=1e-11)

    def test_of_which_one_vanishes(self):
        a, b = np.array([[0.0, 3.0, 0.0, -1.0, 1e-300]]), np.array([[3.0, 0.0, 0.0, 3.0, 1e300]])
        assert (self.found(a, b) == 0.0).all()


class TestLinearGapMeans:
    @staticmethod
    def found(a, b, g, h):
        parts = np.full((5, *a.shape), np.nan)
        linear_gap_means(a, b, g, h, *parts)
        return parts

    def test_is_the_mean_of_either_side_of_the_equation(self, rng):
        """L(a/g^3, b/h^3) / <1/gap^3>, the resistance of a linear gap by many small steps."""
        a, b = np.exp(rng.uniform(-5.0, 5.0, (2, 3, 4)))
        g, h = rng.uniform(0.1, 1.0, (2, 3, 4))
        p, q = a / g**3, b / h**3
        steps = (np.arange(20000) + 0.5) / 20000
        resistance = np.mean((g[..., None] + (h - g)[..., None] * steps) ** -3.0, axis=-1)
        np.testing.assert_allclose(
            self.found(a, b, g, h)[0], (p - q) / np.log(p / q) / resistance, rtol=1e-6
        )

    @pytest.mark.parametrize("moved", range(4))
    def test_slopes_match_central_differences(self, moved, rng):
        state, d = rng.uniform(0.5, 1.5, (4, 2, 3)), 1e-6
        above, below = state.copy(), state.copy()
        above[moved] += d
        below[moved] -= d
        slope = (self.found(*above)[0] - self.found(*below)[0]) / (2.0 * d)
        np.testing.assert_allclose(self.found(*state)[1 + moved], slope, rtol=1e-7)

    def test_of_a_gap_that_vanishes(self):
        a, b = np.array([[0.0, 3.0, -1.0]]), np.array([[3.0, 0.0, 3.0]])
        g, h = np.array([[0.0, 1.0, -0.1]]), np.array([[1.0, 0.0, 0.1]])
        assert (self.found(a, b, g, h) == 0.0).all()
