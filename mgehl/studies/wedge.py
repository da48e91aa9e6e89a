"""The rigid wedge bearing: Figures 7 to 10 of the paper, convergence to the exact series, and a pocket."""

import numpy as np
from scipy.interpolate import CubicSpline

from mgehl.discretization.couette import SCHEMES
from mgehl.model.wedge_series import WedgeSeries
from mgehl.output.center_line import center_line
from mgehl.studies import wedge_pocket
from mgehl.studies.study import merged, observed_order

BASE = {
    "contact": {"kind": "wedge"},
    "wedge": {"exit": 20e-3, "inlet": 50e-3, "width": 20e-3},
    "motion": {"speed": 1.0},
    "discretization": {"cavitation": False},
    "solver": {"tolerance": 1e-10},
}
SHAPES = {
    "square pillar": {"pillar": "square"},
    "cylindrical pillar": {"pillar": "cylinder"},
    "blocked exit": {"blocked_exit": True},
    "no blockage": {},
}
PILLARS = ("square pillar", "cylindrical pillar")
PLACES = (22.0, 30.0, 40.0)
"""X in mm, on the centre line, where the series is compared."""

FIGURE_NODES = 257
NODES = (129, 257, 513, 1025)


def run(study):
    """Solve all cases; write tables `cases`, `convergence` and two of a pocket, figures 7, 8, 9, 10."""
    nodes = study.nodes or NODES
    study.cases = 4 + 3 * len(PILLARS) + 2 * len(SCHEMES) * len(nodes)
    study.cases += len(wedge_pocket.COUETTE) * len(wedge_pocket.LINE_NODES) + len(wedge_pocket.SIZES)
    solutions = _figure_cases(study)
    study.write_table("cases", [_case_row(name, solution) for name, solution in solutions.items()])
    rows = []
    for shape in ("blocked exit", "no blockage"):
        series = WedgeSeries(20.0, 50.0, 20.0, shape == "blocked exit")
        exact = [*series.pressure(np.array(PLACES)), series.load()]
        for couette in SCHEMES:
            rows += _convergence(study, shape, couette, nodes, exact)
    study.write_table("convergence", rows)
    wedge_pocket.run(study, min(max(nodes), FIGURE_NODES))
    from mgehl.studies import wedge_figures  # matplotlib is slow to import

    study.draw("figure_7", wedge_figures.pressure_map, solutions["square pillar"])
    study.draw("figure_8", wedge_figures.pressure_map, solutions["cylindrical pillar"])
    study.draw("figure_9", wedge_figures.center_lines, solutions)
    study.draw("figure_10", wedge_figures.untreated, solutions)


def case(shape, nodes=FIGURE_NODES, couette="1B", interface="closed", turned=False):
    """The tables of one configuration."""
    return merged(
        BASE,
        {
            "wedge": SHAPES[shape] | {"reversed": turned},
            "grid": {"nodes": nodes},
            "discretization": {
                "couette": couette,
                "face_mobility": "arithmetic",
                "couette_at_interface": interface,
            },
        },
    )


def _figure_cases(study):
    """Solutions of the figures by name."""
    solutions = {}
    for shape in SHAPES:
        solutions[shape] = study.solve(shape, case(shape))
    for shape in PILLARS:
        for name, options in (
            (f"{shape}, untreated", {"interface": "untreated"}),
            (f"{shape}, turned", {"turned": True}),
            (f"{shape}, turned, untreated", {"turned": True, "interface": "untreated"}),
        ):
            solutions[name] = study.solve(name, case(shape, **options))
    return solutions


def _case_row(name, solution):
    result = solution.result
    return {
        "case": name,
        "nodes": str(solution.mesh.nx),
        "load mm": f"{result.load:.5f}",
        "largest P 1/mm": f"{result.max_P:.6f}",
        "smallest P 1/mm": f"{result.min_P:.6f}",
        "flow through closed faces": f"{result.closed_face_flow:.1e}",
        "flux imbalance": f"{result.flux_imbalance:.1e}",
        "residual": f"{result.residual:.1e}",
        "iterations": str(result.linear_iterations),
    }


def _convergence(study, shape, couette, nodes, exact):
    """Rows of one scheme: relative errors against the series and the orders from grid to grid."""
    rows, before = [], None
    for n in nodes:
        solution = study.solve(f"{shape}, {couette}, {n} nodes", case(shape, n, couette))
        if not study.first:
            continue
        errors = relative_errors(solution, exact)
        orders = [observed_order(*pair) for pair in zip(before or errors, errors, strict=True)]
        row = {"case": shape, "couette": couette, "nodes": str(n)}
        for name, error, order in zip((*PLACES, "load"), errors, orders, strict=True):
            label = name if name == "load" else f"P({name:g},0)"
            row[f"{label} error %"] = f"{100 * error:+.5f}"
            row[f"{label} order"] = f"{order:.2f}" if before else ""
        row["residual"] = f"{solution.result.residual:.1e}"
        row["flux imbalance"] = f"{solution.result.flux_imbalance:.1e}"
        row["flow through closed faces"] = f"{solution.result.closed_face_flow:.1e}"
        row["iterations"] = str(solution.result.linear_iterations)
        row["wall s"] = f"{solution.result.wall_s:.2f}"
        rows.append(row)
        before = errors
    return rows


def relative_errors(solution, exact):
    """Of P at `PLACES` on the centre line, and of the load."""
    X, P = center_line(solution.mesh, solution.fields)
    if solution.contact.turned:
        X, P = -X[::-1], P[::-1]
    at_places = CubicSpline(X, P)(PLACES)
    found = (*at_places, solution.result.load)
    return [value / reference - 1.0 for value, reference in zip(found, exact, strict=True)]
