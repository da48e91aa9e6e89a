import numpy as np
import pytest

from mgehl.model.images import ACCURACY, fit_images, wave_numbers

K = np.geomspace(2e-3, 5e4, 999)
"""Between the wave numbers of the fit, not on them."""


def test_half_space_has_no_images():
    images = fit_images(lambda k: np.full(k.shape, 2.5))
    assert (images.surface, images.strengths.size, images.error) == (2.5, 0, 0.0)
    assert images.compliance(K).tolist() == [2.5] * K.size
    assert images.widening() == pytest.approx(2.5 ** (1.0 / 3.0), rel=1e-12)


@pytest.mark.parametrize("depth", [1e-3, 0.3, 20.0])
@pytest.mark.parametrize("strength", [-0.75, 30.0])
def test_a_single_image_is_found(depth, strength):
    """One term of the sum itself; between the wave numbers as well as on them."""

    def compliance(k):
        return 1.0 + strength * np.exp(-k * depth)

    images = fit_images(compliance)
    assert images.error <= ACCURACY
    np.testing.assert_allclose(images.compliance(K), compliance(K), rtol=3.0 * ACCURACY)


def test_a_layer_of_springs_is_a_sum_of_images():
    """Springs under the surface add a term in proportion to k; no wave of the grid is beyond it."""
    images = fit_images(lambda k: 1.0 + 0.1 * k)
    np.testing.assert_allclose(images.compliance(K), 1.0 + 0.1 * K, rtol=1e-4)


@pytest.mark.parametrize(
    "compliance",
    [lambda k: 1.0 + k**2, lambda k: 2.0 + np.sin(3.0 * k), lambda k: np.where(k < 1.0, 1.0, 2.0)],
    ids=["without end", "oscillating", "jump"],
)
def test_what_is_no_sum_of_images_is_refused(compliance):
    with pytest.raises(ValueError, match="as a sum of images"):
        fit_images(compliance)


def test_wave_numbers_reach_from_the_domain_into_the_cells():
    """200 semi-axes are a wave number of 0.03/a, cells of the finest grid 2e-4 a one of 2e4/a."""
    k = wave_numbers()
    assert k[0] < 0.01 and k[-1] > 3e4 and (np.diff(k) > 0.0).all()


def test_widening_lies_between_that_of_surface_and_depth():
    """Hertz at the surface's compliance where the change is far below, at that of the depth where it
    is within the surface: 8^(1/3) and 1."""
    for depth, expected in ((1e3, 2.0), (1e-3, 1.0)):
        images = fit_images(lambda k, depth=depth: 8.0 - 7.0 * np.exp(-k * depth))
        assert images.widening() == pytest.approx(expected, rel=0.01)
    between = fit_images(lambda k: 8.0 - 7.0 * np.exp(-k)).widening()
    assert 1.3 < between < 1.9
    # In units of another radius the same body is deeper or shallower.
    assert fit_images(lambda k: 8.0 - 7.0 * np.exp(-2.0 * k)).widening(2.0) == pytest.approx(
        between, rel=1e-5
    )
