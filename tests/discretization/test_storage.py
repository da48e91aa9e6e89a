import numpy as np
import pytest

from mgehl.discretization.axes import own
from mgehl.discretization.status import CAVITATED
from mgehl.discretization.storage import Storage


@pytest.fixture
def fluid(film):
    return film.evaluation().fluid


@pytest.mark.parametrize("rate", [0.0, np.zeros((5, 8))], ids=["number", "array"])
def test_without_a_rate_there_is_no_time_step(fluid, rate):
    assert Storage.begun(fluid, rate) is None


def test_a_rate_at_one_node_is_a_time_step(fluid):
    rate = np.zeros((5, 8))
    rate[2, 3] = 7.0
    assert np.argwhere(Storage.begun(fluid, rate).by_H(fluid)).tolist() == [[2, 3]]


def test_nothing_is_stored_at_the_beginning(fluid):
    assert not Storage.begun(fluid, 3.0).outflow(fluid).any()


def test_what_is_stored_is_the_rate_of_rho_H(film, fluid):
    """Twice the gap in a time step of 1/3."""
    stored = Storage.begun(fluid, 3.0).outflow(film.evaluation(H=2.0 * film.H).fluid)
    np.testing.assert_allclose(stored, 3.0 * own(fluid.rho) * own(film.H), rtol=1e-13)


@pytest.mark.parametrize("by, d", [("P", 1e-6), ("H", 1e-7)])
def test_derivatives_match_central_differences(film, fluid, by, d):
    storage = Storage.begun(fluid, np.arange(1.0, 41.0).reshape(5, 8))
    ahead, behind = (
        storage.outflow(film.evaluation(**{by: getattr(film, by) + s * d}).fluid) for s in (1.0, -1.0)
    )
    measured = (ahead - behind) / (2.0 * d)
    found = getattr(storage, f"by_{by}")(fluid)
    np.testing.assert_allclose(found, measured, rtol=1e-6, atol=1e-8 * np.abs(measured).max())


def test_a_cavity_stores_its_filling(mixed):
    """From 1/4 to 3/4 of the gap in a time step of 1/3; films store nothing."""
    before, after = (mixed.evaluation(filling=np.full(mixed.P.shape, part)).fluid for part in (0.25, 0.75))
    storage, torn = Storage.begun(before, 3.0), own(mixed.status == CAVITATED)
    whole = 3.0 * own(before.rho) * own(before.carried)
    np.testing.assert_allclose(storage.outflow(after), np.where(torn, 0.5 * whole, 0.0), rtol=1e-13)
    np.testing.assert_allclose(storage.by_P(after)[torn], whole[torn], rtol=1e-13)
    np.testing.assert_allclose(storage.by_H(after)[torn], 0.75 * 3.0 * own(after.rho)[torn], rtol=1e-13)
    np.testing.assert_allclose(storage.by_H(after)[~torn], 3.0 * own(after.rho)[~torn], rtol=1e-13)
