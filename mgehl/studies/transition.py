"""From a full film to full contact and back  [Liu fig. 14, table 1], on one grid.

Both branches are followed at the same speeds: where they differ, both are solutions of the same
discrete equations.
"""

import numpy as np

from mgehl.studies import transition_figures as figures
from mgehl.studies.branch import Branches
from mgehl.studies.columns import told
from mgehl.studies.study import PAPER, merged, papers_grid

FASTEST, SLOWEST, COUNT = 7.5e-3, 5e-6, 25
"""m/s: the range of [Liu sec. 4.3]."""

COARSE = 257
"""Up to this many nodes the range begins at `FASTEST_ON_COARSE`: at the paper's there is no film."""

FASTEST_ON_COARSE = 0.1

STEPS = {"max_steps": 30}
"""Most Newton steps: a point that is found takes 10 to 20, one that is not is tried again from a nearer
one."""

PAPER_RADIUS = 19.05e-3
"""The radius that the paper's labels U belong to; its other numbers belong to 12.7 mm."""


def run(study):
    """Walk the branches; write the table `transition-NODES` and the pictures of Figure 14."""
    nodes = study.nodes or (COARSE,)
    directions = ("down", "up") if study.branch == "both" else (study.branch,)
    study.cases = len(nodes) * len(directions) * COUNT
    for n in nodes:
        with Branches(study, case(n)) as branches:
            points = []
            for direction in directions:
                way = speeds(n) if direction == "down" else speeds(n)[::-1]
                points += branches.walk(direction, way, tuple(points))
            study.write_table(f"transition-{n}", [row(branches, point) for point in points])
            study.draw(f"transition-{n}-films", figures.branches, branches, points)
            study.draw(f"transition-{n}-figure-14", figures.figure_14, branches, points)


def speeds(nodes):
    """The speeds of a grid, fast to slow."""
    fastest = FASTEST_ON_COARSE if nodes <= COARSE else FASTEST
    return [float(f"{speed:.4g}") for speed in np.geomspace(fastest, SLOWEST, COUNT)]


def case(nodes):
    """The tables of the headline contact on a grid."""
    return merged(PAPER, {"grid": papers_grid(nodes), "solver": STEPS})


def row(branches, point):
    """Text of one point: the columns of the paper's Table 1, and ours."""
    result, contact = point.result, point.result.contact
    U = branches.contact.at_speed(point.speed).groups.U
    errors = zip(("e^p", "e^p lubr.", "e^p solid"), point.sweep, strict=True)
    return {
        "grid": str(branches.mesh.nx),
        "branch": point.branch,
        "from": point.origin,
        "speed mm/s": f"{1e3 * point.speed:.4g}",
        "U of the paper": f"{U * branches.contact.radius_x / PAPER_RADIUS:.3e}",
        "U": f"{U:.3e}",
        "iterations": str(result.work.steps),
        **{name: f"{error:.1e}" for name, error in errors},
        **told(
            result,
            "load error, settled, residual, central nm, minimum nm, contact/Hertz area, load on contact",
        ),
        "load on fluid": f"{1.0 - contact.load_fraction:.4f}",
        **told(result, "Eq. 2 broken"),
        "by at most p_h": f"{result.other_inequality.worst:.1e}",
        **told(result, "at the interface"),
        "there by at most p_h": f"{result.pressure_inequality.worst:.1e}",
        "not continued because": point.obstacle,
        "nodes that can be neither": str(len(result.contradictions)),
        **told(result, "inlet cells, grid verdict, convolutions:.0f, wall s"),
    }
