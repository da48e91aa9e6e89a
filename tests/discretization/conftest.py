from dataclasses import dataclass

import numpy as np
import pytest

from mgehl.discretization.axes import HALO, own
from mgehl.discretization.evaluation import Evaluation
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.rows import rows_of
from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.model.lubricant import Barus, DowsonHigginson, Lubricant
from mgehl.model.point import PointContact


@pytest.fixture
def contact():
    """An elliptical contact whose Couette and Poiseuille flows are of one size in `State`."""
    lubricant = Lubricant(Barus(0.096, 3e-9), DowsonHigginson())
    return PointContact(800.0, 12.7e-3, 30e-3, 219.78e9, 0.1, lubricant)


@dataclass
class State:
    """Ghosted fields (lines + 2 HALO, nx) of a rank with neighbours on both sides."""

    mesh: Mesh
    contact: PointContact
    P: np.ndarray
    H: np.ndarray
    status: np.ndarray

    def evaluation(self, scheme=None, P=None, H=None, filling=None, storage=None):
        """Of this state, or of another P or H with its status; cavities are full without a `filling`."""
        P, H = self.P if P is None else P, self.H if H is None else H
        how = {"filling": filling, "storage": storage}
        return Evaluation(P, H, self.status, self.mesh, self.contact, scheme or Scheme(), **how)

    @property
    def rows(self):
        return rows_of(own(self.status))


LINES, NODES = 5, 8


@pytest.fixture
def film(contact):
    """Five lines of eight nodes, all lubricated but the line ends; no symmetry anywhere."""
    rng = np.random.default_rng(7)
    shape = LINES + 2 * HALO, NODES
    P, H = rng.uniform(0.2, 0.8, shape), rng.uniform(0.05, 0.15, shape)
    status = np.full(shape, LUBRICATED)
    status[:, [0, -1]] = BOUNDARY
    P[:, [0, -1]] = 0.0
    return State(Mesh(NODES, 17, (-1.9, 1.3), (-1.5, 1.5), k_e=0.6), contact, P, H, status)


@pytest.fixture
def mixed(film):
    """The same with contact (also in ghost lines, also next to a line end) and cavitated nodes."""
    contact = [(0, 6), (1, 4), (3, 3), (3, 4), (4, 3), (4, 1), (6, 5)]
    cavitated = [(3, 5), (4, 6), (5, 6), (7, 2), (2, 2)]
    for nodes, kind in ((contact, CONTACT), (cavitated, CAVITATED)):
        film.status[tuple(zip(*nodes, strict=True))] = kind
    film.P[film.status == CAVITATED] = 0.0
    # The gap of a contact node is zero when converged, and of either sign on the way there.
    film.H[film.status == CONTACT] = [2e-3, 0.0, 1e-3, -2e-3, 0.0, 3e-3, -1e-3]
    return film


@pytest.fixture(params=["film", "mixed"])
def state(request):
    return request.getfixturevalue(request.param)
