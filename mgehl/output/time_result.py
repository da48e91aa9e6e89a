"""What result.json says of a run in time beside the state at its end."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from mgehl.discretization.storage import content
from mgehl.output.film_error import OF_AN_INSTANT
from mgehl.output.passages import TimeResult, means
from mgehl.output.result import summarise

CLOSED = 1e-8
"""Part of the stored oil by which the account of a step may be off."""


def summarise_in_time(problem, outcome, rows, tolerance, work, wall_s, versions):
    """The `Result` of a run in time, its last state verified (collective)."""
    result = summarise(problem, outcome, tolerance, work, wall_s, versions)
    if not rows:
        return replace(result, converged=False, settled=False, reason=outcome.reason, mass=None)
    length = 2e6 * problem.contact.x_scale
    found = _of_rows(rows, length, work, _largest_node(problem, outcome.state))
    off = max(found.largest_closure, found.largest_node)
    settled, reason = result.settled and off <= CLOSED, outcome.reason
    if not result.settled:
        reason = result.reason
    elif not settled:
        reason = f"the account of the oil is off by {off:.1e} of it in a step"
    cut, why = result.edge.wrong
    verdict = {"converged": settled and not cut, "settled": settled, "reason": (settled and why) or reason}
    others = {"mass": None, "flux_imbalance": None, "error": OF_AN_INSTANT}
    return replace(result, **verdict, **others, time=found)


def _largest_node(problem, state):
    """What the balance of a node is off in the last step at the most, over the oil that is stored."""
    if problem.storage is None:
        return 0.0
    evaluation, inner = problem.evaluate(state), ~problem.boundary
    made = np.abs(np.where(inner, evaluation.inflow / problem.storage.rate, 0.0))
    return problem.grid.max(made) / problem.grid.sum(content(evaluation.fluid)[inner].sum())


def _of_rows(rows, length, work, largest_node):
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
