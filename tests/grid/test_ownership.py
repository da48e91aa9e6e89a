from math import log2

import numpy as np
import pytest

from mgehl.grid.ownership import MIN_LINES, active_ranks, coarsened, deal_out, ownerships

LINES = (5, 9, 65, 129, 1025)
RANKS = (1, 2, 3, 7, 16, 20, 40, 600)


def chain(lines, ranks):
    return ownerships(lines, int(log2((lines - 1) / 4)) + 1, ranks)


@pytest.mark.parametrize("lines", LINES)
@pytest.mark.parametrize("ranks", RANKS)
def test_each_line_has_one_owner_and_who_works_has_enough_lines(lines, ranks):
    """The last rank always works, and nobody new on a coarser grid."""
    grids = chain(lines, ranks)
    for starts in grids:
        held = np.diff(starts)
        assert len(starts) == ranks + 1 and starts[0] == 0 and np.all(held >= 0)
        assert held[held > 0].min() >= min(MIN_LINES, starts[-1])
    assert grids[-1][-1] == 5
    workers = [set(active_ranks(starts)) for starts in grids]
    assert all(ranks - 1 in each for each in workers)
    assert all(coarse <= fine for fine, coarse in zip(workers[:-1], workers[1:], strict=True))


def test_a_coarse_line_stays_where_its_fine_line_is():
    fine = deal_out(65, 5)
    owner = np.repeat(range(5), np.diff(fine))
    assert np.repeat(range(5), np.diff(coarsened(fine))).tolist() == owner[::2].tolist()
