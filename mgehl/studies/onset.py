"""The speeds at which contact appears going down, and full contact is lost going up, on each grid."""

import numpy as np

from mgehl.studies.branch import Branches
from mgehl.studies.transition import case

NODES = (129, 257, 513, 1025)
PRECISION = 0.05
STEP = 1.3
"""Ratio of neighbouring speeds on the way to a bracket."""

FIRST_CELLS = 2.5
"""Cells in the inlet where the way down begins: above the loss of the film on every grid."""

FIRST_CONTACT = 2.5e-5
"""m/s on a grid of 1025 nodes where the way up begins, more on coarser ones as the loss is."""

STEP_UP = 1.5

LOST = 0.9
"""Contact over Hertz area below which contact is not full any more."""

DOWN, UP = "contact appears mm/s", "full contact lost mm/s"


def run(study):
    """Bracket both speeds on every grid; write the table `onset`, its powers and the picture."""
    rows = [_row(study, n) for n in study.nodes or NODES]
    study.write_table("onset", rows)
    powers = {column: power(rows, column) for column in (DOWN, UP)}
    study.write_table(
        "onset-powers", [{"speed": name, "power of dX": f"{p:.2f}"} for name, p in powers.items()]
    )
    from mgehl.studies import transition_figures as figures

    study.draw("onset", figures.onset, rows, powers)


def power(rows, column):
    """Exponent of dX that fits a column best."""
    own = [row for row in rows if row[column]]
    if len(own) < 2:
        return float("nan")
    log_dX, log_speed = (np.log([float(row[name]) for row in own]) for name in ("dX", column))
    return float(np.polyfit(log_dX, log_speed, 1)[0])


def _row(study, nodes):
    with Branches(study, case(nodes)) as branches:
        dX = branches.mesh.dX
        fastest = branches.contact.at_speed(1e-9).matched_speed(dX, FIRST_CELLS)
        down = branches.bracket("down", _way(fastest, 1.0 / STEP), _has_contact, PRECISION)
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


def _way(first, ratio):
    return [first * ratio**k for k in range(16)]


def _has_contact(point):
    return not point.result.settled or point.result.contact.nodes > 0


def _has_lost_contact(point):
    return not point.result.settled or point.result.contact.area_fraction < LOST


def _bracket(name, bracket):
    """The mean of a bracket and its ends, empty where there is none."""
    if None in bracket:
        return {name: "", f"{name}: between": ""}
    ends = sorted(1e3 * point.speed for point in bracket)
    return {
        name: f"{np.sqrt(ends[0] * ends[1]):.4g}",
        f"{name}: between": f"{ends[0]:.4g} and {ends[1]:.4g}",
    }


def _cells(bracket):
    return f"{bracket[1].result.resolution.inlet_cells:.2f}" if bracket[1] else ""


def _inequality(point):
    if point is None:
        return ""
    inequality = point.result.pressure_inequality
    return f"{inequality.violations} of {inequality.checked}, {inequality.worst:.1e} p_h"
