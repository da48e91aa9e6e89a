"""Lines and columns of one plane; several ranks are tested in tests/parallel."""

import numpy as np
import pytest
from mpi4py import MPI

from mgehl.grid.plane import SentPlane, plane_of

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
