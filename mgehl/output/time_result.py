"""What result.json says of a run in time beside the state at its end."""

from dataclasses import replace
from itertools import pairwise

from mgehl.output.passages import TimeResult, means
from mgehl.output.result import summarise

CLOSED = 1e-8
"""Part of the stored oil by which the account of a step may be off."""


def summarise_in_time(problem, outcome, rows, settings, work, wall_s, versions):
    """The `Result` of a run in time, its last state verified (collective)."""
    result = summarise(problem, outcome, settings.tolerance, work, wall_s, versions)
    if not rows:
        return replace(result, converged=False, settled=False, reason=outcome.reason, mass=None)
    length = 2e6 * problem.contact.x_scale
    found = _of_rows(rows, length, work)
    closes = found.largest_closure <= CLOSED
    reason = outcome.reason
    if outcome.converged and not closes:
        reason = f"the account of the oil is off by {found.largest_closure:.1e} of it in a step"
    settled = outcome.converged and closes
    cut, why = result.edge.wrong
    verdict = {"converged": settled and not cut, "settled": settled, "reason": (settled and why) or reason}
    return replace(result, **verdict, mass=None, flux_imbalance=None, time=found)


def _of_rows(rows, length, work):
    each = [after["convolutions"] - before["convolutions"] for before, after in pairwise(rows)]
    gone = sum(abs(row["speed_mm_s"]) * 1e3 * row["step_s"] for row in rows)
    return TimeResult(
        end_s=rows[-1]["time_s"],
        steps=len(rows),
        halved=sum(row["halvings"] > 0 for row in rows),
        largest_closure=max(abs(row["closure"]) for row in rows),
        convolutions_a_step=sorted(each)[len(each) // 2] if each else work.convolutions,
        passages=gone / length,
        means=means(rows, length),
    )
