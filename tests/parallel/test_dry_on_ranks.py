import numpy as np
import pytest
from both import COMM, both, same_fields
from dry_surfaces import surface
from mpi4py import MPI

from mgehl.discretization.mesh import Mesh
from mgehl.grid.hierarchy import Hierarchy
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


def test_the_inverse_is_that_of_one_rank(paper_contact):
    contact = paper_contact(surface=surface("rough 50 nm"), radius_y=25.4e-3)
    mesh = Mesh(65, 65, (-1.9, 1.3), (-1.5, 1.5), contact.k_e)
    whole = np.zeros((65, 65))
    whole[1:-1, 1:-1] = np.random.default_rng(2).random((63, 63))
    found = []
    for comm in (COMM, MPI.COMM_SELF):
        hierarchy = Hierarchy(mesh, 65, contact.kernel, comm)
        grid = hierarchy.grids[0]
        found.append(hierarchy.deflections[0].inverted(whole[grid.first : grid.last]).copy())
        if comm is COMM:
            own = slice(grid.first, grid.last)
        hierarchy.destroy()
    np.testing.assert_allclose(found[0], found[1][own], rtol=0.0, atol=1e-10 * np.abs(found[1]).max())
