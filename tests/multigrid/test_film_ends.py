"""A coarse film ends where the fine one does, be it halfway between two of its nodes."""

import numpy as np
import pytest

from mgehl.discretization.residual import Linearisation
from mgehl.discretization.rows import rows_of
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.multigrid.film_ends import end_halfway

CROSS = np.array([(0, 0), (0, -1), (0, 1), (-1, 0), (1, 0)])
LAST = 40
"""The fine film's last line, or node of a line."""


@pytest.fixture
def transfer(paper_contact, make_hierarchy):
    return make_hierarchy(paper_contact(), 65).transfers[0]


@pytest.fixture
def laplacian(transfer):
    """Function: the five-point stencil after the film has ended beyond `LAST` along an axis."""

    def make(axis, last=LAST, beyond=CAVITATED):
        grid = transfer.fine
        status = np.where(np.indices(grid.shape)[axis] > last, beyond, LUBRICATED).astype(np.int8)
        status = np.where(grid.boundary(), BOUNDARY, status)
        A = np.ones((len(CROSS), *transfer.coarse.shape))
        A[0] = -4.0
        linearisation = Linearisation(CROSS, A, None, None)
        rows = rows_of(status)
        end_halfway(linearisation, transfer.inject(rows), transfer, rows, status)
        return linearisation.A

    return make


def product(A, p):
    """A p of inner nodes."""
    sides = p[1:-1, :-2], p[1:-1, 2:], p[:-2, 1:-1], p[2:, 1:-1]
    inner = A[:, 1:-1, 1:-1]
    return inner[0] * p[1:-1, 1:-1] + sum(a * side for a, side in zip(inner[1:], sides, strict=True))


@pytest.mark.parametrize("axis", [0, 1])
def test_a_pressure_that_falls_evenly_to_zero_halfway_is_solved(laplacian, transfer, axis):
    """As that which falls to zero at a node of the coarse grid."""
    place = 2 * np.indices(transfer.coarse.shape)[axis]
    for last in (LAST, LAST + 1):
        p = np.maximum(last + 1.0 - place, 0.0)
        film = place[1:-1, 1:-1] <= last
        assert film.any() and not product(laplacian(axis, last), p)[film].any()


def test_contact_is_no_cavity(laplacian):
    assert (laplacian(1, beyond=CONTACT)[0] == -4.0).all()
