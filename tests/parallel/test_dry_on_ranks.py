import numpy as np
import pytest
from both import COMM, both, same_fields

from mgehl.studies.dry import tables_of

pytestmark = pytest.mark.parallel


@pytest.mark.parametrize("name, nodes", [("smooth", 65), ("rough 500 nm", 257)])
def test_it_is_that_of_one_rank(name, nodes):
    together, alone = both(tables_of(name, nodes))
    assert together.result.contact.nodes == alone.result.contact.nodes
    assert together.result.work == alone.result.work
    ours, theirs = (vars(each.result.dry_error) for each in (together, alone))
    assert ours.pop("how") == theirs.pop("how")
    assert ours == pytest.approx(theirs, rel=1e-6)
    fields = same_fields(together, alone, P=1e-9)
    if name != "smooth":
        np.testing.assert_allclose(fields.heights, alone.heights, rtol=0.0, atol=1e-20)
        assert (together.heights is None) == (COMM.rank > 0)
    assert together.H0 == pytest.approx(alone.H0, rel=1e-12)
