"""Line-contact films over speeds and loads against the formulas."""

from math import pi

from mgehl.studies.study import merged

NODES = (4097,)
SPEEDS = (0.01, 0.03, 0.1, 0.3, 1.0, 3.0)
"""m/s."""
PRESSURES = (0.5, 1.0, 1.5, 2.26)
"""Largest Hertz pressure, GPa."""
RADIUS, MODULUS = 12.7e-3, 219.78e9

BASE = {
    "contact": {"kind": "line", "radius_x": RADIUS, "reduced_modulus": MODULUS},
    "grid": {"x": [-6.0, 2.0]},
}


def load_at(pressure):
    """Load per length (N/m) of a largest Hertz pressure (Pa): p_h = sqrt(w E'/(2 pi R))."""
    return 2.0 * pi * RADIUS * pressure**2 / MODULUS


def run(study):
    """Solve all; write the table `films` and the picture `films`."""
    (nodes,) = study.nodes or NODES
    study.cases = len(SPEEDS) * len(PRESSURES)
    rows = []
    for pressure in PRESSURES:
        for speed in SPEEDS:
            case = {
                "contact": {"load_per_length": load_at(1e9 * pressure)},
                "motion": {"speed": speed},
                "grid": {"nodes": nodes},
            }
            title = f"{pressure:g} GPa, {1e3 * speed:g} mm/s"
            rows.append(_row(pressure, speed, study.solve(title, merged(BASE, case)).result))
    study.write_table("films", rows)
    from mgehl.studies import film_figures

    study.draw("films", film_figures.line, rows)


def _row(pressure, speed, result):
    row = {
        "p_h GPa": f"{pressure:g}",
        "speed mm/s": f"{1e3 * speed:g}",
        "M": f"{result.groups.M:.2f}",
        "L": f"{result.groups.L:.2f}",
        "converged": "yes" if result.converged else "no",
        "inlet cells": f"{result.resolution.inlet_cells:.1f}",
    }
    row["contact nodes"] = str(result.contact.nodes) if result.converged else ""
    for film in ("central", "minimum"):
        found = getattr(result, f"{film}_film_nm")
        formula = result.formulas[f"dowson_higginson_{film}_nm"]
        row[f"{film} nm"] = f"{found:.3f}" if result.converged else ""
        row[f"{film} formula nm"] = f"{formula:.3f}"
        row[f"{film} deviation %"] = f"{100 * (found / formula - 1):+.1f}" if result.converged else ""
    return row
