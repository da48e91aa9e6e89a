import numpy as np
import pytest

from mgehl.discretization.axes import own
from mgehl.discretization.status import CAVITATED
from mgehl.discretization.storage import Storage


@pytest.fixture
def fluid(film):
    return film.evaluation().fluid


def test_what_is_stored_is_the_rate_of_rho_H(film, fluid):
    """Twice the gap in a time step of 1/3."""
    stored = Storage.begun(fluid, 3.0).outflow(film.evaluation(H=2.0 * film.H).fluid)
    np.testing.assert_allclose(stored, 3.0 * own(fluid.rho) * own(film.H), rtol=1e-13)


def test_a_cavity_stores_its_filling(mixed):
    """From 1/4 to 3/4 of the gap in a time step of 1/3; films store nothing."""
    before, after = (mixed.evaluation(filling=np.full(mixed.P.shape, part)).fluid for part in (0.25, 0.75))
    storage, torn = Storage.begun(before, 3.0), own(mixed.status == CAVITATED)
    whole = 3.0 * own(before.rho) * own(before.carried)
    np.testing.assert_allclose(storage.outflow(after), np.where(torn, 0.5 * whole, 0.0), rtol=1e-13)
    np.testing.assert_allclose(storage.by_P(after)[torn], whole[torn], rtol=1e-13)
    np.testing.assert_allclose(storage.by_H(after)[torn], 0.75 * 3.0 * own(after.rho)[torn], rtol=1e-13)
    np.testing.assert_allclose(storage.by_H(after)[~torn], 3.0 * own(after.rho)[~torn], rtol=1e-13)
