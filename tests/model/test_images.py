import numpy as np
import pytest

from mgehl.model.images import ACCURACY, fit_images

K = np.geomspace(2e-3, 5e4, 999)
"""Between the wave numbers of the fit, not on them."""


@pytest.mark.parametrize("depth", [1e-3, 0.3, 20.0])
@pytest.mark.parametrize("strength", [-0.75, 30.0])
def test_a_single_image_is_found(depth, strength):
    """One term of the sum itself; between the wave numbers as well as on them."""

    def compliance(k):
        return 1.0 + strength * np.exp(-k * depth)

    images = fit_images(compliance)
    assert images.error <= ACCURACY
    np.testing.assert_allclose(images.compliance(K), compliance(K), rtol=3.0 * ACCURACY)


@pytest.mark.parametrize(
    "compliance",
    [lambda k: 1.0 + k**2, lambda k: 2.0 + np.sin(3.0 * k), lambda k: np.where(k < 1.0, 1.0, 2.0)],
    ids=["without end", "oscillating", "jump"],
)
def test_what_is_no_sum_of_images_is_refused(compliance):
    with pytest.raises(ValueError, match="as a sum of images"):
        fit_images(compliance)
