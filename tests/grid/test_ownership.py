"""Which rank holds which lines."""

from math import log2

import numpy as np
import pytest

from mgehl.grid.ownership import MIN_LINES, active_ranks, coarsened, deal_out, ownerships

LINES = (5, 9, 65, 129, 1025)
RANKS = (1, 2, 3, 7, 16, 20, 40, 600)


def chain(lines, ranks):
    """Ownerships from the finest grid to one of five lines."""
    return ownerships(lines, int(log2((lines - 1) / 4)) + 1, ranks)


@pytest.mark.parametrize("lines", LINES)
@pytest.mark.parametrize("ranks", RANKS)
class TestEveryGrid:
    def test_each_line_has_one_owner(self, lines, ranks):
        for starts in chain(lines, ranks):
            assert len(starts) == ranks + 1 and starts[0] == 0
            assert np.all(np.diff(starts) >= 0)
        assert chain(lines, ranks)[-1][-1] == 5

    def test_who_works_has_enough_lines(self, lines, ranks):
        for starts in chain(lines, ranks):
            held = np.diff(starts)
            assert held[held > 0].min() >= min(MIN_LINES, starts[-1])

    def test_the_last_rank_always_works_and_nobody_new_on_a_coarser_grid(self, lines, ranks):
        workers = [set(active_ranks(starts)) for starts in chain(lines, ranks)]
        assert all(ranks - 1 in each for each in workers)
        assert all(coarse <= fine for fine, coarse in zip(workers[:-1], workers[1:], strict=True))


def test_a_coarse_line_stays_where_its_fine_line_is():
    fine = deal_out(65, 5)
    owner = np.repeat(range(5), np.diff(fine))
    assert np.repeat(range(5), np.diff(coarsened(fine))).tolist() == owner[::2].tolist()
