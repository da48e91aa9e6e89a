"""Which corrections of earlier systems are kept."""

import numpy as np
import pytest

from mgehl.multigrid.memory import softest


@pytest.mark.parametrize("most, kept", [(9, [0, 1]), (1, [0])])
def test_what_the_cycle_corrects_well_is_not_kept(most, kept):
    """Images of .1, .4, .9 and 3 times their causes: half of a cause is left of the first two or more."""
    causes = np.eye(4)
    images = np.diag([0.1, 0.4, 0.9, 3.0])
    weights = softest(images @ images.T, images @ causes.T, most)
    assert weights.shape == (4, len(kept))
    assert weights.T @ images @ images.T @ weights == pytest.approx(np.eye(len(kept)))
    assert not np.delete(weights, kept, axis=0).any()


def test_a_cycle_that_corrects_all_leaves_nothing_to_remember():
    assert softest(np.eye(3), np.eye(3), 9).shape == (3, 0)
