from dataclasses import dataclass

import numpy as np
import pytest

from mgehl.discretization.mesh import Mesh
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
    """Ghosted fields (lines + 2, nx) of a rank with neighbours on both sides."""

    mesh: Mesh
    P: np.ndarray
    H: np.ndarray
    status: np.ndarray


@pytest.fixture
def film():
    """Five lines of eight nodes, all lubricated but the line ends; no symmetry anywhere."""
    rng = np.random.default_rng(7)
    mesh = Mesh(8, 17, (-1.9, 1.3), (-1.5, 1.5), k_e=0.6)
    P = rng.uniform(0.2, 0.8, (7, 8))
    H = rng.uniform(0.05, 0.15, (7, 8))
    status = np.full((7, 8), LUBRICATED)
    status[:, [0, -1]] = BOUNDARY
    P[:, [0, -1]] = 0.0
    return State(mesh, P, H, status)


@pytest.fixture
def mixed(film):
    """The same with contact (also in a ghost line, also next to a line end) and cavitated nodes."""
    contact = [(0, 4), (2, 3), (2, 4), (3, 3), (3, 1), (5, 5)]
    cavitated = [(2, 5), (3, 6), (4, 6), (6, 2), (1, 2)]
    for nodes, kind in ((contact, CONTACT), (cavitated, CAVITATED)):
        film.status[tuple(zip(*nodes, strict=True))] = kind
    film.P[film.status == CAVITATED] = 0.0
    # The gap of a contact node is zero when converged, and of either sign on the way there.
    film.H[film.status == CONTACT] = [0.0, 1e-3, -2e-3, 0.0, 3e-3, -1e-3]
    return film


@pytest.fixture(params=["film", "mixed"])
def state(request):
    return request.getfixturevalue(request.param)
