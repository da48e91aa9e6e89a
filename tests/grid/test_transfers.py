import numpy as np
import pytest

from mgehl.discretization.rows import rows_of
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.grid.transfers import PartitionedTransfer

INNER = (slice(1, -1), slice(1, -1))


def kinds(*status):
    return tuple((each, rows_of(each)) for each in status)


@pytest.fixture
def transfer(paper_contact, make_hierarchy):
    return make_hierarchy(paper_contact(), 65).transfers[0]


def test_bilinear_reproduces_bilinear_functions(transfer):
    def function(grid):
        return 2.0 + 3.0 * grid.X - 1.5 * grid.Y + 0.7 * grid.X * grid.Y

    np.testing.assert_allclose(
        transfer.bilinear(function(transfer.coarse)), function(transfer.fine), rtol=0.0, atol=1e-13
    )


def test_cubic_reproduces_cubic_functions_between_nodes_with_pressure(transfer):
    """Bilinear where a line ends: the function is no line there, and its mean is not its middle."""

    def function(grid):
        return 40.0 + grid.X**3 - 2.0 * grid.Y**3 + grid.X * grid.Y

    found, expected = transfer.cubic(function(transfer.coarse)), function(transfer.fine)
    np.testing.assert_allclose(found[2:-2, 2:-2], expected[2:-2, 2:-2], rtol=1e-14)
    assert not np.allclose(found, expected, rtol=1e-6)


def test_cubic_is_bilinear_beside_nodes_without_pressure_and_never_negative(transfer):
    coarse = np.zeros(transfer.coarse.shape)
    coarse[10, 10:13] = 1.0
    np.testing.assert_array_equal(transfer.cubic(coarse), transfer.bilinear(coarse))
    coarse[10, 9:14] = 100.0, 1.0, 1.0, 100.0, 0.0
    np.testing.assert_array_equal(transfer.cubic(coarse)[20, 18:25], [100, 50.5, 1, 1, 1, 50.5, 100])


def test_full_weighting_is_a_quarter_of_the_adjoint_of_bilinear(transfer):
    random = np.random.default_rng(1)
    fine = random.standard_normal(transfer.fine.shape)
    coarse = np.zeros(transfer.coarse.shape)
    coarse[INNER] = random.standard_normal(coarse[INNER].shape)
    weighted = np.vdot(transfer.full_weighting(fine), coarse)
    assert weighted == pytest.approx(0.25 * np.vdot(fine, transfer.bilinear(coarse)), rel=1e-12)


def test_the_average_keeps_a_constant_everywhere_and_the_ends_of_lines(transfer):
    np.testing.assert_allclose(transfer.averaged(np.full(transfer.fine.shape, 3.0)), 3.0, rtol=1e-14)
    fine = np.random.default_rng(2).random(transfer.fine.shape)
    averaged = transfer.averaged(fine)
    np.testing.assert_array_equal(averaged[:, [0, -1]], fine[::2, [0, -1]])
    np.testing.assert_allclose(averaged[INNER], transfer.full_weighting(fine)[INNER], rtol=1e-14)


class TestPartitioned:
    @pytest.fixture
    def status(self, transfer):
        X, Y = transfer.fine.X, transfer.fine.Y
        status = np.where(X**2 + Y**2 < 0.49, CONTACT, LUBRICATED)
        status = np.where(X > 0.9, CAVITATED, status)
        return np.where(transfer.fine.boundary(), BOUNDARY, status).astype(np.int8)

    @pytest.fixture
    def coarse_status(self, transfer, status):
        return transfer.inject(status)

    @pytest.fixture
    def partitioned(self, transfer, status, coarse_status):
        partitioned = PartitionedTransfer(transfer)
        partitioned.partition(*kinds(coarse_status, status))
        return partitioned

    @pytest.mark.parametrize("kind, other", [(LUBRICATED, CONTACT), (CONTACT, LUBRICATED)])
    def test_the_kinds_are_kept_apart(self, partitioned, status, coarse_status, kind, other):
        coarse = partitioned.restrict(np.where(status == kind, 1.0, 0.0))
        fine = partitioned.prolong(np.where(coarse_status == kind, 1.0, 0.0))
        for found, kinds in ((coarse, coarse_status), (fine, status)):
            assert np.all(found[kinds == kind] > 0.0)
            np.testing.assert_array_equal(found[kinds == other], 0.0)

    def test_a_constant_residual_of_contact_is_halved_and_its_correction_stays(
        self, partitioned, status, coarse_status
    ):
        coarse = partitioned.restrict(np.where(status == CONTACT, 4.0, 0.0))
        np.testing.assert_allclose(coarse[coarse_status == CONTACT], 2.0, rtol=1e-13)
        fine = partitioned.prolong(np.where(coarse_status == CONTACT, 5.0, 0.0))
        np.testing.assert_allclose(fine[status == CONTACT], 5.0, rtol=1e-13)


def test_on_one_line_full_weighting_is_half_of_the_adjoint_of_bilinear(make_line):
    """A coarse node stands for two fine ones, not for four."""
    transfer = make_line(9, coarsest=5).transfers[0]
    random = np.random.default_rng(1)
    fine, coarse = random.standard_normal((1, 9)), np.zeros((1, 5))
    coarse[:, 1:-1] = random.standard_normal((1, 3))
    weighted = np.vdot(transfer.full_weighting(fine), coarse)
    assert weighted == pytest.approx(0.5 * np.vdot(fine, transfer.bilinear(coarse)), rel=1e-12)
