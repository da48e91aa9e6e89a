"""A pad with a pocket: beside a reference in one dimension, beside published figures in two."""

from pathlib import Path

import numpy as np

from mgehl.output.center_line import center_line
from mgehl.studies import pocket_reference as reference
from mgehl.studies.study import BEST, merged, observed_order

BASE = {
    "contact": {"kind": "wedge"},
    "wedge": {
        "length": reference.LENGTH, "inlet_film": reference.INLET_FILM, "exit_film": reference.EXIT_FILM,
        "ambient_pressure": reference.AMBIENT, "pressure_laws": True, "pocket_depth": reference.DEPTH,
        "pocket_from": reference.POCKET[0], "pocket_to": reference.POCKET[1],
    },
    "lubricant": {
        "viscosity": reference.VISCOSITY, "viscosity_law": "barus",
        "pressure_viscosity": reference.PRESSURE_VISCOSITY,
        "density_law": f"{Path(reference.__file__)}:density",
    },
    "motion": {"speed": reference.SPEED},
    "discretization": {"cavitation": True},
}  # fmt: skip

LINE_NODES = (513, 1025, 2049, 4097, 8193)
COUETTE = ("1B", "2C", "3B")

SIZES = {"small": (10e-3, 7e-3), "large": (300e-3, 210e-3)}
"""Widths of pad and pocket in m."""

FIGURES = (
    (0.0521, 0.5285, 0.5568), (0.10328, 0.4585, 0.6277), (0.1521, 0.3502, 0.655),
    (0.20188, 0.0655, 0.2922), (0.25211, 0.0508, 0.0328), (0.30141, 0.131, 3.6856),
    (0.35194, 0.1842, 11.2009), (0.40094, 0.1965, 19.6899), (0.45305, 1.8529, 30.131),
    (0.50366, 8.5038, 41.8093), (0.5451, 7.5573, 39.7461), (0.60178, 6.2882, 35.9975),
    (0.65523, 5.3462, 32.6075), (0.70227, 4.8472, 28.8888), (0.75474, 4.01, 24.396),
    (0.80094, 3.3064, 20.2283), (0.84478, 2.8631, 16.0194), (0.8987, 2.135, 10.16),
    (0.95497, 0.9998, 4.7544),
)  # fmt: skip
"""x/L, and the pressure in MPa on the centre line of the small and of the large slider, as they were read
from figures of Bertocchi et al.: to some .3 MPa, by what they say of the cavity."""


def case(nodes, couette="3B", size=None):
    """The tables of one configuration; without a `size` nothing varies across the motion."""
    pad, pocket = SIZES.get(size, (10e-3, None))
    wide = {"width": pad, "sides": "open", "pocket_width": pocket} if size else {"sides": "closed"}
    return merged(
        BASE,
        {
            "wedge": wide,
            "grid": {"nodes": nodes},
            "discretization": BEST | {"couette": couette},
        },
    )


def run(study, nodes):
    """Write tables `pocket_orders` and `pocket`, that on a grid of so many `nodes` a side."""
    answer = reference.solve()
    study.write_table("pocket_orders", [row for each in COUETTE for row in _orders(study, each, answer)])
    study.write_table("pocket", _beside_figures(study, nodes))


def pressures(solution):
    """x in m and the pressure in Pa on the centre line."""
    X, P = center_line(solution.mesh, solution.fields)
    return X * solution.contact.x_scale, P * solution.contact.pressure_scale


def difference(solution, answer):
    """The largest difference to the reference at any node, and that of the largest pressures, relative."""
    x, p = pressures(solution)
    largest = answer.p.max()
    beside = np.interp(x, np.pad(answer.x, 1, constant_values=(0.0, reference.LENGTH)),
                       np.pad(answer.p, 1, constant_values=reference.AMBIENT))  # fmt: skip
    return np.abs(p - beside).max() / largest, p.max() / largest - 1.0


def _orders(study, couette, answer):
    """Rows of one scheme in one dimension, beside the reference."""
    rows, before = [], None
    for n in LINE_NODES:
        solution = study.solve(f"pocket, {couette}, {n} nodes", case(n, couette))
        if not study.first:
            rows.append({})
            continue
        (error, of_largest), result = difference(solution, answer), solution.result
        x, p = pressures(solution)
        torn = 1e3 * x[p == 0.0]
        rows.append({
            "couette": couette, "nodes": str(n), "largest difference %": f"{100 * error:.4f}",
            "order": f"{observed_order(before, error):.2f}" if before else "",
            "largest pressure %": f"{100 * of_largest:+.4f}",
            "torn from mm": f"{torn[0]:.3f}", "to mm": f"{torn[-1]:.3f}",
            "oil made": f"{result.mass.made_share:.0e}", "steps": str(len(solution.rows) - 1),
        })  # fmt: skip
        before = error
    return rows


def _beside_figures(study, nodes):
    """Rows by x: the pressures of both sliders, and how far they are from the published ones."""
    places = reference.LENGTH * np.array(FIGURES)[:, 0]
    columns = {"x/L": [f"{each[0]:.3f}" for each in FIGURES]}
    for k, size in enumerate(SIZES, 1):
        solution = study.solve(f"pocket, {size}, {nodes} nodes", case(nodes, size=size))
        if study.first:
            published = np.array(FIGURES)[:, k]
            MPa = 1e-6 * np.interp(places, *pressures(solution))
            columns[f"{size} MPa"] = [f"{each:.3f}" for each in MPa]
            columns[f"{size}, figure"] = [f"{each:.3f}" for each in published]
            columns[f"{size}, difference"] = [f"{each:+.3f}" for each in MPa - published]
    return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]
