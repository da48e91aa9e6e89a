"""Lines and columns of one plane; several ranks are tested in tests/parallel."""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.grid.plane import SentPlane, even_shares, even_widths, plane_of, shares_of_work

LINES, COLUMNS = 5, 8
STARTS = np.array([0, LINES])


@pytest.fixture(params=["alone", "sent"])
def plane(request):
    make = {"alone": plane_of, "sent": SentPlane}[request.param]
    made = make(MPI.COMM_SELF, STARTS, [COLUMNS], complex)
    yield made
    made.destroy()


def test_columns_have_what_was_written_to_the_lines(plane):
    lines = np.arange(LINES * COLUMNS).reshape(LINES, COLUMNS) * (1.0 + 2.0j)
    plane.lines[:] = lines
    plane.to_columns()
    np.testing.assert_array_equal(plane.columns, lines)
    plane.columns[:] += 1.0
    plane.to_lines()
    np.testing.assert_array_equal(plane.lines, lines + 1.0)


def test_no_rank_has_more_columns_than_the_last():
    for columns in range(1, 12):
        for ranks in range(1, 6):
            widths = even_widths(columns, ranks)
            assert sum(widths) == columns and max(widths) == widths[-1] <= min(widths) + 1
            assert even_shares(columns, ranks)[-1] == (columns - widths[-1], columns)


def test_shares_of_work_are_equal_to_half_a_column():
    work = np.random.default_rng(2).random(101) + 0.1
    for ranks in (1, 2, 3, 7):
        shares = shares_of_work(work, ranks)
        assert [first for first, _ in shares] == [0, *(end for _, end in shares[:-1])]
        assert shares[-1][1] == len(work)
        parts = [work[first:end].sum() for first, end in shares]
        assert max(parts) - work.sum() / ranks <= work.max() and len(shares) == ranks
