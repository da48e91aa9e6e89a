"""Which rank holds which lines of a grid.

An ownership is an array `starts`: the first lines of all ranks and, last, the number of lines. A rank
may hold none. The last rank has lines on every grid: it has H0, too.
"""

import numpy as np

MIN_LINES = 4
"""Lines that a rank which works on a grid has at the least. A halo needs 2, bands of y-lines 4. By a model
of messages 4 and 8 are equally fast on 20 to 512 ranks; 2 and 16 are slower."""


def ownerships(lines, grids, ranks):
    """Of so many grids, the finest first: a line stays with its rank as long as that has enough to do."""
    found = [deal_out(lines, ranks)]
    for _ in range(grids - 1):
        found.append(regrouped(coarsened(found[-1])))
    return found


def deal_out(lines, ranks):
    """Ownership of a finest grid: all ranks share it, or as many of the last ones as have enough to do."""
    return _shared_by(np.arange(ranks)[-_most_ranks(lines) :], lines, ranks)


def coarsened(starts):
    """Ownership of the grid of every other line: each stays with the rank of the same fine line."""
    return (starts + 1) // 2


def regrouped(starts):
    """The same ownership if its ranks have enough lines, else one of every second rank, and so on."""
    lines, workers = int(starts[-1]), active_ranks(starts)
    if np.diff(starts)[workers].min() >= MIN_LINES:
        return starts
    while len(workers) > _most_ranks(lines):
        workers = workers[::-2][::-1]
    return _shared_by(workers, lines, len(starts) - 1)


def active_ranks(starts):
    """The ranks that hold lines, in order."""
    return np.flatnonzero(np.diff(starts))


def _most_ranks(lines):
    """How many ranks can have enough to do."""
    return max(lines // MIN_LINES, 1)


def _shared_by(workers, lines, ranks):
    """Ownership in which some of the ranks share the lines evenly, and the others have none."""
    held = np.zeros(ranks, dtype=int)
    held[workers] = lines // len(workers)
    held[workers[: lines % len(workers)]] += 1
    return np.concatenate(([0], np.cumsum(held)))
