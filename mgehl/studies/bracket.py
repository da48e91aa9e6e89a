"""Films by three means of the mobility, grid by grid: they differ by the mobility's error."""

from mgehl.studies.branch import Branches
from mgehl.studies.study import merged
from mgehl.studies.transition import case

NODES = (129, 257, 513, 1025)
MEANS = ("arithmetic", "geometric", "harmonic")
SPEEDS = (0.1, 0.06, 0.034, 0.02, 0.01, 0.0075, 0.004, 0.0015)
"""m/s, those of the design notes and the paper's."""

STEPS = {"geometric": {"solver": {"max_steps": 60}}, "harmonic": {"solver": {"max_steps": 150}}}
"""Most Newton steps: single nodes at the film's edge come close to folds of these means, and take many."""

AGREEMENT = 0.05
AGREEMENT_SPEED = 0.0075


def run(study):
    """Follow each mean down on each grid; write the tables `bracket` and `agreement`, and the picture."""
    nodes = study.nodes or NODES
    study.cases = len(nodes) * len(MEANS) * len(SPEEDS)
    rows = [row for n in nodes for row in _rows_of_grid(study, n)]
    study.write_table("bracket", rows)
    study.write_table("agreement", [_agreement(rows, str(n)) for n in nodes])
    from mgehl.studies import transition_figures as figures

    study.draw("bracket", figures.bracket, nodes, rows)


def _rows_of_grid(study, nodes):
    """All means, the arithmetic one first: where it has a full film the others begin with that."""
    rows, arithmetic = [], ()
    for mean in MEANS:
        with Branches(study, merged(case(nodes, mean), STEPS.get(mean, {}))) as branches:
            points = branches.walk("down", SPEEDS, arithmetic=arithmetic)
            rows += [_row(branches, mean, point) for point in points]
        arithmetic = arithmetic or points
    return rows


def _row(branches, mean, point):
    # Of this speed: a point that did not settle may have been left at another on the way.
    result, formulas = point.result, branches.contact.at_speed(point.speed).formulas
    return {
        "grid": str(branches.mesh.nx),
        "mean": mean,
        "speed mm/s": f"{1e3 * point.speed:.4g}",
        "from": point.origin,
        "settled": "yes" if result.settled else "no",
        "central nm": f"{result.central_film_nm + 0.0:.3f}",
        "minimum nm": f"{result.minimum_film_nm + 0.0:.3f}",
        "contact/Hertz area": f"{result.contact.area_fraction:.4f}",
        "Eq. 2 broken": str(result.other_inequality.violations),
        "inlet cells": f"{result.resolution.inlet_cells:.2f}",
        "residual": f"{result.residual:.1e}",
        "central formula nm": f"{1e9 * formulas.hamrock_dowson_central:.3f}",
        "minimum formula nm": f"{1e9 * formulas.hamrock_dowson_minimum:.3f}",
        "steps": str(result.work.steps),
        "convolutions": f"{result.work.convolutions:.0f}",
    }


def _agreement(rows, grid):
    """How far apart the means' films are at the paper's speed, relative to their middle."""
    speed = f"{1e3 * AGREEMENT_SPEED:.4g}"
    own = [
        row
        for row in rows
        if row["grid"] == grid and row["speed mm/s"] == speed and row["settled"] == "yes"
    ]
    row = {"grid": grid, "speed mm/s": speed, "means": str(len(own))}
    for film in ("central", "minimum"):
        apart = _spread([float(each[f"{film} nm"]) for each in own])
        agree = len(own) == len(MEANS) and apart <= AGREEMENT
        row[f"{film} spread"] = f"{100 * apart:.1f} %"
        row[f"{film} agrees to 5 %"] = "yes" if agree else "no"
    return row


def _spread(heights):
    """Largest less smallest over their middle, NaN without a film."""
    if not heights or max(heights) <= 0.0:
        return float("nan")
    return 2.0 * (max(heights) - min(heights)) / (max(heights) + min(heights))
