from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import dblquad, quad
from scipy.special import j0

from mgehl.model.coating import Coating
from mgehl.model.deformation import HalfSpace, LayeredHalfSpace
from mgehl.model.images import Images, fit_images

X, Y = np.array([-0.05, 0.05, 0.15, 0.25]), np.array([-0.1, 0.1, 0.3])
"""Lines between rectangles of 0.1 by 0.2, the first of them around (0, 0)."""


def one_image(depth, surface=0.0):
    return Images(surface, np.array([1.0]), np.array([depth]), 0.0)


@pytest.mark.parametrize("depth", [0.02, 0.3, 5.0])
def test_an_image_is_integrated_exactly(depth):
    found = LayeredHalfSpace(2.0, one_image(depth)).of_rectangles(X, Y)
    assert found.shape == (2, 3)
    for j, i in np.ndindex(found.shape):

        def integrand(y, x):
            return 2.0 / np.sqrt(x**2 + y**2 + depth**2)

        expected = dblquad(integrand, *X[i : i + 2], *Y[j : j + 2], epsabs=1e-12, epsrel=1e-10)[0]
        assert found[j, i] == pytest.approx(expected, rel=1e-9)


def test_without_images_it_is_the_half_space_to_the_last_bit():
    layered = LayeredHalfSpace(0.7, fit_images(np.ones_like))
    np.testing.assert_array_equal(layered.of_rectangles(X, Y), HalfSpace(0.7).of_rectangles(X, Y))


def deflection_by_a_point_force(compliance, r):
    """(1/pi) of the integral of c(k) J0(kr) by quadrature from zero to zero of J0, less c_0/r."""
    surface = float(compliance(np.array(1e4)))
    zeros = (np.arange(1, 4000) - 0.25) * np.pi / r
    ends = [0.0, *zeros[zeros < 400.0], 400.0]

    def integrand(k):
        return (compliance(np.array(k)) - surface) * j0(k * r)

    parts = (quad(integrand, *pair, epsabs=1e-12, epsrel=1e-10)[0] for pair in pairwise(ends))
    return surface / r + sum(parts)


@pytest.mark.parametrize(
    "modulus, poisson, thickness",
    [(800e9, 0.3, 0.1), (50e9, 0.3, 0.3), (4e9, 0.45, 1.0)],
    ids=["hard", "soft", "polymer"],
)
def test_coating_against_the_hankel_integral(modulus, poisson, thickness):
    """Lengths in units of a. Where a small cell is far away its pressure is a point force.

    A soft layer that is hardly compressible bulges beside the force: there the deflection is negative.
    """
    compliance = Coating(thickness, modulus, poisson, None, 0.3, 219.78e9).compliance
    kernel, cell = LayeredHalfSpace(1.0, fit_images(compliance)), 1e-4
    for r in (0.1, 0.4, 2.0):
        x, y = np.array([r - cell, r + cell]), np.array([-cell, cell])
        force = kernel.of_rectangles(x, y)[0, 0] / (4.0 * cell**2)
        expected = deflection_by_a_point_force(compliance, r)
        assert force == pytest.approx(expected, rel=1e-6, abs=1e-6 * compliance(1e4) / r)
