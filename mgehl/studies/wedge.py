"""The rigid wedge bearing: Figures 7 to 10 of the paper and convergence to the exact series."""

import numpy as np
from scipy.interpolate import CubicSpline

from mgehl.discretization.couette import SCHEMES
from mgehl.model.wedge_series import WedgeSeries
from mgehl.output.centre_line import centre_pressure
from mgehl.output.pictures import style, wedge_picture
from mgehl.studies.columns import told
from mgehl.studies.limits import order_of_errors
from mgehl.studies.study import merged

BASE = {
    "contact": {"kind": "wedge"},
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

COLOURS = dict(zip(SHAPES, (*style.COLOURS[:3], style.COLOURS[-1]), strict=True))

LIMITS = (-0.026, 0.018)
"""P of both pressure maps, as one colour scale."""

FIGURE_NODES = 257
NODES = (129, 257, 513, 1025)


def run(study):
    """Solve all cases; write tables `cases` and `convergence`, figures 7, 8, 9, 10."""
    nodes = study.asked.nodes or NODES
    study.expected = 4 + 3 * len(PILLARS) + 2 * len(SCHEMES) * len(nodes)
    solutions = {name: study.solve(name, tables) for name, tables in _figure_cases().items()}
    study.write_table("cases", [_case_row(name, solution) for name, solution in solutions.items()])
    rows = []
    for shape in ("blocked exit", "no blockage"):
        series = WedgeSeries(20.0, 50.0, 20.0, shape == "blocked exit")
        exact = [*series.pressure(np.array(PLACES)), series.load()]
        for couette in SCHEMES:
            rows += _convergence(study, shape, couette, nodes, exact)
    study.write_table("convergence", rows)
    study.draw("figure_7", pressure_map, solutions["square pillar"])
    study.draw("figure_8", pressure_map, solutions["cylindrical pillar"])
    study.draw("figure_9", centre_lines, solutions)
    study.draw("figure_10", untreated, solutions)


def case(shape, nodes=FIGURE_NODES, couette="1B", interface="closed", turned=False):
    """The tables of one configuration."""
    scheme = {"couette": couette, "face_mobility": "arithmetic", "couette_at_interface": interface}
    wedge = SHAPES[shape] | {"reversed": turned}
    return merged(BASE, {"wedge": wedge, "grid": {"nodes": nodes}, "discretization": scheme})


def _figure_cases():
    """Tables of the figures' cases by name."""
    cases = {shape: case(shape) for shape in SHAPES}
    for shape in PILLARS:
        cases[f"{shape}, untreated"] = case(shape, interface="untreated")
        cases[f"{shape}, turned"] = case(shape, turned=True)
        cases[f"{shape}, turned, untreated"] = case(shape, turned=True, interface="untreated")
    return cases


def _case_row(name, solution):
    numbers = "load mm, largest P 1/mm, smallest P 1/mm, flow through closed faces, flux imbalance"
    return {
        "case": name,
        "nodes": str(solution.mesh.nx),
        **told(solution.result, f"{numbers}, residual, iterations"),
    }


def _convergence(study, shape, couette, nodes, exact):
    """Rows of one scheme: relative errors against the series and the orders from grid to grid."""
    rows, before = [], None
    for n in nodes:
        solution = study.solve(f"{shape}, {couette}, {n} nodes", case(shape, n, couette))
        if not study.first:
            continue
        errors = relative_errors(solution, exact)
        row = {"case": shape, "couette": couette, "nodes": str(n)}
        for name, error, coarse in zip((*PLACES, "load"), errors, before or errors, strict=True):
            label = name if name == "load" else f"P({name:g},0)"
            row[f"{label} error %"] = f"{100 * error:+.5f}"
            row[f"{label} order"] = f"{order_of_errors(coarse, error):.2f}" if before else ""
        numbers = "residual, flux imbalance, flow through closed faces, iterations, wall s:.2f"
        rows.append(row | told(solution.result, numbers))
        before = errors
    return rows


def relative_errors(solution, exact):
    """Of P at `PLACES` on the centre line, and of the load."""
    X, P = centre_pressure(solution.mesh, solution.fields)
    if solution.contact.turned:
        X, P = -X[::-1], P[::-1]
    at_places = CubicSpline(X, P)(PLACES)
    found = (*at_places, solution.result.load)
    return [value / reference - 1.0 for value, reference in zip(found, exact, strict=True)]


def pressure_map(solution):
    """Figures 7 and 8: the pressure over the pad."""
    figure, axes = style.subplots(size=(6.2, 3.9))
    wedge_picture.pressure_map(axes, solution, LIMITS, extend="both")
    axes.set_title(f"{solution.contact.pillar} pillar (grey); the film moves towards small X")
    return figure


def centre_lines(solutions):
    """Figure 9: all four cases on Y = 0, the blocked exit's series as marks."""
    figure, axes = style.subplots(size=(6.8, 4.4))
    for shape, colour in COLOURS.items():
        dash = "--" if shape == "no blockage" else "-"
        line = centre_pressure(solutions[shape].mesh, solutions[shape].fields)
        axes.plot(*line, dash, color=colour, label=shape)
    X = np.linspace(20.0, 48.0, 15)
    series = WedgeSeries(20.0, 50.0, 20.0, True)
    label = "blocked exit, series"
    axes.plot(X, series.pressure(X), "s", color=COLOURS["blocked exit"], label=label)
    _finish(axes, "Figure 9: pressure on Y = 0")
    return figure


def untreated(solutions):
    """Figure 10: what an untreated Couette flow does, in both orientations."""
    figure, panels = style.subplots(1, 2, size=(11.5, 4.4))
    titles = ("(a) film moves against the differencing", "(b) turned: with the differencing")
    for axes, turned, title in zip(panels, ("", ", turned"), titles, strict=True):
        for shape in PILLARS:
            for case, dash, label in (("", "-", shape), (", untreated", "--", f"{shape}, NTCF")):
                solution = solutions[f"{shape}{turned}{case}"]
                line = centre_pressure(solution.mesh, solution.fields)
                axes.plot(*line, dash, color=COLOURS[shape], label=label)
        _finish(axes, title)
    figure.suptitle("Figure 10: scheme 1B with and without treatment of the Couette flow (NTCF)")
    return figure


def _finish(axes, title):
    axes.axhline(0.0, color="0.8", linewidth=0.8, zorder=0)
    axes.set(xlabel="X, mm", ylabel="P = m$^2$p/($\\eta$u), 1/mm", title=title)
    axes.legend()
