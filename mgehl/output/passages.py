"""Means of a run in time over passages: what an engineer asks of roughness that moves.

A passage is the time in which the mean surface goes the length of the Hertz contact. The band of a mean is
what the means of the last two passages differ by; it has settled where that is little.
"""

from itertools import pairwise

import numpy as np

from mgehl.output.result import Mean, TimeResult

SETTLED = 0.01
"""Part of a mean that its band may be; of a load share that part of the load."""

FEWEST = 3
"""Passages before means are asked whether they have settled: the first one begins."""

OF_A_LENGTH = ("mean_gap_nm", "central_film_nm", "minimum_film_nm", "max_pressure_GPa")
OF_THE_LOAD = ("load_on_contact", "load_on_solids", "friction")


def means(rows, length):
    """{name: `Mean`} of the last passage of `length` in um; empty before the end of the first."""
    path = np.array([row["path_um"] for row in rows])
    gone = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(path, prepend=0.0)))])
    if gone[-1] < length:
        return {}
    weights = np.array([row["step_s"] for row in rows])
    last, before = (gone[1:] > gone[-1] - length), (gone[1:] <= gone[-1] - length)
    before &= gone[1:] > gone[-1] - 2.0 * length
    found = {}
    for name in (*OF_A_LENGTH, *OF_THE_LOAD):
        values = np.array([row[name] for row in rows])
        mean = float(np.average(values[last], weights=weights[last]))
        two = gone[-1] >= 2.0 * length and before.any()
        earlier = float(np.average(values[before], weights=weights[before])) if two else None
        found[name] = Mean(mean, None if earlier is None else abs(mean - earlier))
    return found


def have_settled(rows, length):
    """Whether the means of gap and load on solids have settled after `FEWEST` passages."""
    if sum(abs(row["speed_mm_s"]) * 1e3 * row["step_s"] for row in rows) < FEWEST * length:
        return False
    found = means(rows, length)
    gap, solids = found["mean_gap_nm"], found["load_on_solids"]
    return gap.band <= SETTLED * gap.value and solids.band <= SETTLED


def time_result(rows, length, work, largest_node):
    """The `TimeResult` of the rows of a history; `length` in um is that of a passage."""
    each = [after["convolutions"] - before["convolutions"] for before, after in pairwise(rows)]
    gone = sum(abs(row["speed_mm_s"]) * 1e3 * row["step_s"] for row in rows)
    return TimeResult(
        end_s=rows[-1]["time_s"],
        steps=len(rows),
        halved=sum(row["halvings"] > 0 for row in rows),
        largest_closure=max(abs(row["closure"]) for row in rows),
        largest_node=largest_node,
        convolutions_a_step=sorted(each)[len(each) // 2] if each else work.convolutions,
        passages=gone / length,
        means=means(rows, length),
    )
