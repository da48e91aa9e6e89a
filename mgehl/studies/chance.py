"""Rough contacts drawn by chance, for several studies: how all are solved, and what is said of them.

Scheme, domain and start are left to mgehl, as a user who knows little of them leaves them.
"""

from dataclasses import dataclass
from math import log

import numpy as np

from mgehl.studies.columns import statistic, told
from mgehl.studies.study import merged, verdict

SEED = 4099
"""No constant was chosen on the machines that it draws; on its rollers that contact of a line opens node by
node (`recipe`); on its balls `recipe.CERTAIN` and those of `elimination`. Who chooses one takes another
seed: so went 2030."""

BALL = {
    "surface": {"kind": "self-affine", "longest_wavelength": 200e-6},
    "grid": {"x": [-2.0, 1.5], "y": [-1.75, 1.75]},
}
"""The paper's steel ball on a ground disc (nested tables of a configuration)."""


@dataclass(frozen=True)
class Drawn:
    """What chance chose for a case; `number` counts from 1 and is the seed of its surface."""

    number: int
    what: str
    tables: dict
    """Its configuration but for the grid's nodes, nested."""

    @property
    def title(self):
        return f"{self.number}: {self.what}"


def run_drawn(study, name, draw, row, nodes, cases):
    """Solve what `draw(cases, seed)` finds; write a table of the `row` of each case and a summary. On so
    many `nodes`, and so many `cases`, where the study is not told others."""
    (nodes,) = study.asked.nodes or (nodes,)
    drawn = {case.title: case for case in study.drawn(draw, cases, SEED)}
    tables = {title: merged(case.tables, {"grid": {"nodes": nodes}}) for title, case in drawn.items()}
    rows, results = {}, []
    for title, solution in study.solved(tables):
        rows[title] = row(drawn[title], solution)
        results.append(solution.result)
    for title, why in study.lost.items():
        rows[title] = {"case": str(drawn[title].number), "verdict": f"NOT SOLVED: {why}"}
    study.write_table(name, sorted(rows.values(), key=lambda each: int(each["case"])))
    study.write_table(f"{name}-summary", [summary(results, len(study.lost))])


def by_logarithm(chance, low, high):
    """A number between two, drawn evenly by its logarithm."""
    return float(np.exp(chance.uniform(log(low), log(high))))


def answer(result):
    """Text of who carries the load, of the oil that was made, of work and verdict."""
    mixed = result.mixed
    return {
        "load on contact": f"{mixed.contact_load_share:.4f}",
        "load on solids": f"{mixed.solid_load_fraction:.4f}",
        **told(result, "made, convolutions, steps"),
        "verdict": verdict(result),
    }


def summary(results, lost=0):
    """The row of the summary of these `Result`s, and of how many have none: verdicts, work, oil, bands."""
    converged = [each for each in results if each.converged]
    settled = sum(each.settled for each in results)
    all_work, work = ([each.work.convolutions for each in some] for some in (results, converged))
    banded = [each for each in converged if each.mixed.error and each.mixed.error.mean_nm is not None]
    return {
        "cases": str(len(results) + lost),
        "converged": str(len(converged)),
        "in doubt": str(settled - len(converged)),
        "not settled": str(len(results) + lost - settled),
        "convolutions, mean": statistic(np.mean, all_work),
        "median": statistic(np.median, all_work),
        "most": statistic(np.max, all_work),
        "mean of the converged": statistic(np.mean, work),
        "largest made": statistic(np.max, (each.mass.made_share for each in converged), "{:.1e}"),
        "with a band about the mean gap": str(len(banded)),
    }
