"""The speeds at which contact appears going down, and full contact is lost going up, on each grid.

Contact appears at the sides of the Hertz ellipse, on the last line of nodes inside. So its speed is
bracketed again on grids that are slightly wider or narrower across: there the last line lies elsewhere in
the cell that the side cuts.
"""

import numpy as np

from mgehl.discretization.status import CONTACT
from mgehl.studies.branch import Branches
from mgehl.studies.study import PAPERS_DOMAIN, merged
from mgehl.studies.transition import case

NODES = (129, 257, 513, 1025)
PRECISION = 0.05
STEP = 1.3
"""Ratio of neighbouring speeds on the way to a bracket."""

FIRST_CELLS = 2.5
"""Cells in the inlet where the way down begins: above the loss of the film on every grid."""

FIRST_CONTACT = 2.5e-5
"""m/s at which the way up begins on 1025 nodes. On coarser grids full contact is lost at higher speeds, and
the way begins higher."""

STEP_UP = 1.5

LOST = 0.9
"""Contact over Hertz area below which contact is not full any more."""

BEYOND = (1 / 6, 1 / 3, 1 / 2, 2 / 3, 5 / 6)
"""Cells from the last line inside the ellipse to its side; the grids' own have 1/3 and 2/3 by turns."""

DOWN, UP = "contact appears mm/s", "full contact lost mm/s"


def run(study):
    """Bracket both speeds on every grid; write the tables `onset` and `sides`, the powers, the picture."""
    nodes = study.nodes or NODES
    rows = [_row(study, n) for n in nodes]
    study.write_table("onset", rows)
    sides = [_side_row(study, n, beyond) for beyond in BEYOND for n in nodes]
    study.write_table("sides", sides)
    powers = {column: power(rows, column) for column in (DOWN, UP)}
    at_one_place = {
        f"{DOWN}, side {beyond:.2f} cells beyond a line": power(_of_side(sides, beyond), DOWN)
        for beyond in BEYOND
    }
    study.write_table(
        "onset-powers",
        [{"speed": name, "power of dX": f"{p:.2f}"} for name, p in (powers | at_one_place).items()],
    )
    from mgehl.studies import transition_figures as figures

    study.draw("onset", figures.onset, rows, sides, powers)


def power(rows, column):
    """Exponent of dX that fits a column best."""
    own = [row for row in rows if row[column]]
    if len(own) < 2:
        return float("nan")
    log_dX, log_speed = (np.log([float(row[name]) for row in own]) for name in ("dX", column))
    return float(np.polyfit(log_dX, log_speed, 1)[0])


def _row(study, nodes):
    with Branches(study, case(nodes)) as branches:
        dX, down = branches.mesh.dX, _down(branches)
        slowest = FIRST_CONTACT * (1024.0 / (nodes - 1)) ** 2
        up = branches.bracket("up", _way(slowest, STEP_UP), _has_lost_contact, PRECISION)
    return {
        "grid": str(nodes),
        "dX": f"{dX:.4e}",
        **_bracket(DOWN, down),
        "inlet cells there": _cells(down),
        **_bracket(UP, up),
        "Eq. 2 broken before": _inequality(up[0]),
    }


def _side_row(study, nodes, beyond):
    with Branches(study, merged(case(nodes), {"grid": {"y": across(nodes, beyond)}})) as branches:
        mesh, down = branches.mesh, _down(branches)
    return {
        "grid": str(nodes),
        "dX": f"{mesh.dX:.4e}",
        "side beyond a line": f"{beyond:.2f}",
        **_bracket(DOWN, down),
        "inlet cells there": _cells(down),
        "first contact at": _place(mesh, down[1]) if study.first else "",
    }


def across(nodes, beyond):
    """grid.y nearest to the paper's so that Y = 1 lies `beyond` cells from the last line inside."""
    half = (nodes - 1) // 2
    default = PAPERS_DOMAIN["y"][1]
    lines = round(half / default - beyond)
    # Rounded, as 1.5 need be no other configuration than the paper's.
    end = round(half / (lines + beyond), 12)
    return -end, end


def _of_side(rows, beyond):
    return [row for row in rows if row["side beyond a line"] == f"{beyond:.2f}"]


def _down(branches):
    """The bracket of the speed at which contact appears."""
    fastest = branches.contact.at_speed(1e-9).matched_speed(branches.mesh, FIRST_CELLS)
    return branches.bracket("down", _way(fastest, 1.0 / STEP), _has_contact, PRECISION)


def _way(first, ratio):
    return [first * ratio**k for k in range(16)]


def _has_contact(point):
    return not point.result.settled or point.result.contact.nodes > 0


def _has_lost_contact(point):
    return not point.result.settled or point.result.contact.area_fraction < LOST


def _bracket(name, bracket):
    """The mean of a bracket, its ends, and what was found at the second; empty where there is none."""
    if None in bracket:
        return {name: "", f"{name}: between": "", f"{name}: found there": ""}
    ends = sorted(1e3 * point.speed for point in bracket)
    return {
        name: f"{np.sqrt(ends[0] * ends[1]):.4g}",
        f"{name}: between": f"{ends[0]:.4g} and {ends[1]:.4g}",
        f"{name}: found there": _found(bracket[1].result),
    }


def _found(result):
    """What a branch became, or why it could not be followed any further."""
    if not result.settled:
        return f"nothing: {result.reason}"
    return f"contact at {result.contact.nodes} nodes, {result.contact.area_fraction:.4f} of Hertz's"


def _cells(bracket):
    return f"{bracket[1].result.resolution.inlet_cells:.2f}" if bracket[1] else ""


def _place(mesh, point):
    """X and |Y| of the contact node furthest to the side; on the rank that has the fields."""
    if point is None or not point.result.contact.nodes:
        return ""
    j, i = np.argwhere(point.fields.status == CONTACT).T
    furthest = np.argmax(np.abs(mesh.Y[j]))
    return f"{mesh.X[i[furthest]]:.4f}, {abs(mesh.Y[j[furthest]]):.4f}"


def _inequality(point):
    if point is None:
        return ""
    inequality = point.result.other_inequality
    return f"{inequality.violations} of {inequality.checked}, {inequality.worst:.1e} p_h"
