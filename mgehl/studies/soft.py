"""Films of soft bodies, which yield to pressures that hardly stiffen the oil: found or not, beside Moes'
formulas."""

from mgehl.studies.study import BEST

MODULUS, RADIUS = 8e9, 10e-3
VISCOSITY, PRESSURE_VISCOSITY = 0.05, 12e-9
"""Of polymer on steel in a thin oil; SI."""

NODES = {"line": 513, "point": 129}
LINES = [(M, L, 1.0) for L in (0.2, 0.3, 0.5, 0.8, 1.2, 2.0, 3.0) for M in (2, 5, 10, 30, 100, 300)]
POINTS = [
    (M, L, ratio)
    for L in (0.3, 0.5, 0.8, 1.2, 2.0)
    for M in (10, 50, 200, 500, 1500)
    for ratio in (1.0, 4.0)
]
"""M, L, and radius across over radius along the motion."""


def run(study):
    """Solve all; write the table `contacts`."""
    study.cases = len(LINES) + len(POINTS)
    cases = [("line", *each) for each in LINES] + [("point", *each) for each in POINTS]
    study.write_table("contacts", [_row(study, *case) for case in cases])


def soft(kind, M, L, ratio=1.0):
    """The tables of a "line" or "point" contact by its Moes numbers, on the domain of "auto"."""
    two_U = (L / (PRESSURE_VISCOSITY * MODULUS)) ** 4
    if kind == "line":
        load = {"load_per_length": M * two_U**0.5 * MODULUS * RADIUS}
    else:
        load = {"load": M * two_U**0.75 * MODULUS * RADIUS**2, "radius_y": ratio * RADIUS}
    return {
        "contact": {"kind": kind, "radius_x": RADIUS, "reduced_modulus": MODULUS, **load},
        "lubricant": {
            "viscosity": VISCOSITY, "pressure_viscosity": PRESSURE_VISCOSITY, "density_law": "constant",
        },
        "motion": {"speed": 0.5 * two_U * MODULUS * RADIUS / VISCOSITY},
        "grid": {"nodes": NODES[kind]},
        "discretization": BEST,
    }  # fmt: skip


def _row(study, kind, M, L, ratio):
    solution = study.solve(f"{kind}, M {M}, L {L:g}, {ratio:g}:1", soft(kind, M, L, ratio))
    result, formula = solution.result, 1e9 * solution.contact.flooded_film
    return {
        "contact": kind if kind == "line" else f"point, {ratio:g}:1",
        "M": f"{M}",
        "L": f"{L:g}",
        "converged": "yes" if result.converged else "no",
        "inlet cells": f"{result.resolution.inlet_cells:.1f}",
        "central nm": f"{result.central_film_nm:.3f}" if result.converged else "",
        "Moes' formula nm": f"{formula:.3f}",
        "convolutions": f"{result.work.convolutions:.0f}",
    }
