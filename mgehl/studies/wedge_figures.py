"""Figures 7 to 10 of the paper, drawn from the wedge study's solutions."""

import numpy as np

from mgehl.model.wedge_series import WedgeSeries
from mgehl.output.center_line import center_line
from mgehl.output.pictures import style, wedge_picture

SHAPES = ("square pillar", "cylindrical pillar", "blocked exit", "no blockage")
COLOURS = dict(zip(SHAPES, (*style.COLOURS[:3], style.COLOURS[-1]), strict=True))

LIMITS = (-0.026, 0.018)
"""P of both pressure maps, as one colour scale."""


def pressure_map(solution):
    """Figures 7 and 8: the pressure over the pad."""
    figure, axes = style.subplots(size=(6.2, 3.9))
    wedge_picture.pressure_map(axes, solution, LIMITS, extend="both")
    axes.set_title(f"{solution.contact.pillar} pillar (grey); the film moves towards small X")
    return figure


def center_lines(solutions):
    """Figure 9: all four cases on Y = 0, the blocked exit's series as marks."""
    figure, axes = style.subplots(size=(6.8, 4.4))
    for shape, colour in COLOURS.items():
        dash = "--" if shape == "no blockage" else "-"
        line = center_line(solutions[shape].mesh, solutions[shape].fields)
        axes.plot(*line, dash, color=colour, label=shape)
    X = np.linspace(20.0, 48.0, 15)
    series = WedgeSeries(20.0, 50.0, 20.0, True)
    label = "blocked exit, series"
    axes.plot(X, series.pressure(X), "s", color=COLOURS["blocked exit"], markersize=4, label=label)
    _finish(axes, "Figure 9: pressure on Y = 0")
    return figure


def untreated(solutions):
    """Figure 10: what an untreated Couette flow does, in both orientations."""
    figure, panels = style.subplots(1, 2, size=(11.5, 4.4))
    titles = ("(a) film moves against the differencing", "(b) turned: with the differencing")
    for axes, turned, title in zip(panels, ("", ", turned"), titles, strict=True):
        for shape in ("square pillar", "cylindrical pillar"):
            for case, dash, label in (("", "-", shape), (", untreated", "--", f"{shape}, NTCF")):
                solution = solutions[f"{shape}{turned}{case}"]
                line = center_line(solution.mesh, solution.fields)
                axes.plot(*line, dash, color=COLOURS[shape], label=label)
        _finish(axes, title)
    figure.suptitle("Figure 10: scheme 1B with and without treatment of the Couette flow (NTCF)")
    return figure


def _finish(axes, title):
    axes.axhline(0.0, color="0.8", linewidth=0.8, zorder=0)
    axes.set(xlabel="X, mm", ylabel="P = m$^2$p/($\\eta$u), 1/mm", title=title)
    axes.legend(frameon=False)
