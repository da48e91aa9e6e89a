"""Block by block as at once."""

import numpy as np
import pytest

from mgehl.grid import transforms
from mgehl.grid.transforms import PlaneTransforms


@pytest.fixture
def plane(make_hierarchy, paper_contact):
    """Grid of 33 by 33 nodes, values and an even kernel on it."""
    grid = make_hierarchy(paper_contact(), 33).grids[-1]
    rng = np.random.default_rng(3)
    return grid, rng.standard_normal(grid.shape), rng.standard_normal(grid.shape)


def product(grid, kernel, values):
    """By FFT, over a period of 64 nodes along both axes."""
    plane, out = PlaneTransforms(grid, 64, 64), np.zeros(grid.shape)
    plane.product(values, plane.spectrum(kernel), out)
    plane.destroy()
    return out / plane.scale


def test_a_product_is_the_double_sum_over_a_period(plane):
    grid, values, kernel = plane
    away = np.abs(np.subtract.outer(np.arange(33), np.arange(33)))
    expected = np.einsum("jlik,lk->ji", kernel[away][:, :, away], values)
    found = product(grid, kernel, values)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * np.max(np.abs(expected)))


@pytest.mark.parametrize("numbers", (1, 3 * 64, 7 * 64))
def test_the_block_makes_no_difference(plane, monkeypatch, numbers):
    grid, values, kernel = plane
    whole = product(grid, kernel, values)
    monkeypatch.setattr(transforms, "BLOCK", numbers)
    found = product(grid, kernel, values)
    np.testing.assert_allclose(found, whole, rtol=0, atol=1e-14 * np.max(np.abs(whole)))
