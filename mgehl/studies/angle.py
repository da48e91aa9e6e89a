"""Entrainment at an angle to the axes: what the angle should change, and what it should not.

A circular contact has the same films at every angle, apart from the grid's error. The films of an ellipse
change; they are compared with formulas. Full contact is the dry contact at every angle.
"""

import numpy as np

from mgehl.discretization.status import CONTACT
from mgehl.model.films import chittenden
from mgehl.output.words import span
from mgehl.studies.study import merged, papers_grid, plausible, richardson

NODES = (129, 257, 513)
SCHEMES = ("1B", "2B")
SIDE = [-1.9, 1.9]
"""Ends of a square domain, which is larger: a corner is farther upstream than a side."""

CIRCLE = {"motion": {"speed": 1.0}}
CIRCLE_ANGLES = (0, 15, 30, 45)

WIDE_SIDE = [-3.8, 3.8]
WIDE_ANGLES = (0, 45)
"""The same cells on twice the domain, by 2B: a difference that remains there is not the domain's."""

ELLIPSE = {
    "contact": {"load": 300.0, "radius_x": 10e-3, "radius_y": 83e-3},
    "motion": {"speed": 0.5},
    "grid": {"nodes": 257, "x": [-3.0, 3.0], "y": [-3.0, 3.0]},
    "discretization": {"couette": "2B"},
}
"""Semi-axes of 4 to 1, the long one along y."""
ELLIPSE_ANGLES = (0, 15, 30, 45, 60, 75, 90)

CONTACT_CASE = {"motion": {"speed": 5e-6}, "grid": papers_grid(257), "solver": {"start": "contact"}}
CONTACT_ANGLES = (0, 45)


def run(study):
    """Solve all; write the tables `circle`, `ellipse`, `contact` and `wide`, and the picture `films`."""
    nodes = study.nodes or NODES
    on_grids = len(SCHEMES) * len(CIRCLE_ANGLES) + len(WIDE_ANGLES)
    study.cases = on_grids * len(nodes) + len(ELLIPSE_ANGLES) + len(CONTACT_ANGLES)
    circle = []
    for couette in SCHEMES:
        circle += _circle_rows(study, couette, nodes, CIRCLE_ANGLES, SIDE)
    study.write_table("circle", circle)
    ellipse = [_ellipse_row(_solve(study, "ellipse", ELLIPSE, angle)) for angle in ELLIPSE_ANGLES]
    study.write_table("ellipse", ellipse)
    contacts = [_solve(study, "full contact", CONTACT_CASE, angle) for angle in CONTACT_ANGLES]
    study.write_table("contact", _contact_rows(contacts) if study.first else [])
    from mgehl.studies import film_figures

    study.draw("films", film_figures.angles, circle, ellipse)
    doubled = [2 * n - 1 for n in nodes]
    study.write_table("wide", _circle_rows(study, "2B", doubled, WIDE_ANGLES, WIDE_SIDE))


def _solve(study, what, case, angle):
    return study.solve(f"{what}, {angle} degrees", merged(case, {"motion": {"angle": angle}}))


def _circle_rows(study, couette, nodes, angles, side):
    """The circular contact at these angles by one scheme, grid by grid."""
    rows, differences = [], {angle: [] for angle in angles}
    for n in nodes:
        grid = {"nodes": n, "x": side, "y": side}
        case = merged(CIRCLE, {"grid": grid, "discretization": {"couette": couette}})
        found = [_outcome(_solve(study, f"circle, {couette}, {n} nodes", case, a)) for a in angles]
        along, _ = found[0]
        for angle, (result, gmres) in zip(angles, found, strict=True):
            differences[angle].append(result.central_film_nm - along.central_film_nm)
            rows.append(_circle_row(couette, n, angle, result, gmres, along, differences[angle]))
    return rows


def _circle_row(couette, nodes, angle, result, gmres, along, differences):
    work, off = result.work.convolutions, differences[-1]
    return {
        "couette": couette,
        "nodes": str(nodes),
        "angle": str(angle),
        "converged": _yes(result.converged),
        "central nm": f"{result.central_film_nm:.4f}",
        "minimum nm": f"{result.minimum_film_nm:.4f}",
        "central off 0 degrees nm": f"{off:+.4f}" if angle else "",
        "in %": f"{100 * off / along.central_film_nm:+.3f}" if angle else "",
        "its limit, order": _limit(differences) if angle else "",
        "convolutions": f"{work:.0f}",
        "over 0 degrees": f"{work / along.work.convolutions:.2f}",
        "most GMRES iterations": str(gmres),
    }


def _limit(values):
    """Richardson's limit in nm and the order, from three grids whose differences show one."""
    if len(values) < 3:
        return ""
    limit, order = richardson(values)
    return f"{limit:+.3f}, {order:.2f}" if plausible(order) else "not to be told yet"


def _outcome(solution):
    """The result and the most iterations of GMRES in a step on the finest grid."""
    finest = [row for row in solution.rows if row["grid"] == solution.mesh.nx]
    return solution.result, max(row["linear_iterations"] for row in finest)


def _ellipse_row(solution):
    """Films beside those of formulas."""
    contact, (result, gmres) = solution.contact, _outcome(solution)
    like, formulas = contact.aligned, contact.formulas
    central, minimum = chittenden(contact.groups, like.radius_x, like.radius_y)
    return {
        "angle": f"{contact.angle:g}",
        "converged": _yes(result.converged),
        "radius along mm": f"{1e3 * like.radius_x:.3f}",
        "radius across mm": f"{1e3 * like.radius_y:.3f}",
        "inlet cells": f"{result.resolution.inlet_cells:.2f}",
        "central nm": f"{result.central_film_nm:.3f}",
        "central Chittenden nm": f"{1e9 * central:.3f}",
        "central Hamrock-Dowson nm": f"{1e9 * formulas.hamrock_dowson_central:.3f}",
        "minimum nm": f"{result.minimum_film_nm:.3f}",
        "minimum Chittenden nm": f"{1e9 * minimum:.3f}",
        "minimum Hamrock-Dowson nm": f"{1e9 * formulas.hamrock_dowson_minimum:.3f}",
        "convolutions": f"{result.work.convolutions:.0f}",
        "most GMRES iterations": str(gmres),
    }


def _contact_rows(solutions):
    """Rows of full contact, whose nodes are counted against those at the first angle."""
    first = solutions[0].fields.status == CONTACT
    rows = []
    for solution in solutions:
        result, gmres = _outcome(solution)
        contact, inequality = result.contact, result.other_inequality
        differ = int(np.count_nonzero((solution.fields.status == CONTACT) != first))
        rows.append(
            {
                "angle": f"{solution.contact.angle:g}",
                "converged": _yes(result.converged),
                "Eq. 2 broken": f"{inequality.violations} of {inequality.checked}",
                "contact nodes": str(contact.nodes),
                "other than at 0 degrees": str(differ),
                "contact on X": span(contact.x_nodes),
                "on Y": span(contact.y_nodes),
                "contact/Hertz area": f"{contact.area_fraction:.5f}",
                "residual": f"{result.residual:.1e}",
                "convolutions": f"{result.work.convolutions:.0f}",
                "most GMRES iterations": str(gmres),
            }
        )
    return rows


def _yes(converged):
    return "yes" if converged else "no"
