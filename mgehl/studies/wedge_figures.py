"""Figures 7 to 10 of the paper, drawn from the wedge study's solutions."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
import numpy as np  # noqa: E402

from mgehl.model.wedge_series import WedgeSeries  # noqa: E402
from mgehl.output import wedge_picture  # noqa: E402
from mgehl.output.center_line import center_line  # noqa: E402
from mgehl.output.picture import STYLE  # noqa: E402

COLOURS = {
    "square pillar": "#0072B2",
    "cylindrical pillar": "#D55E00",
    "blocked exit": "#009E73",
    "no blockage": "#555555",
}
"""Colour-blind safe (Okabe and Ito)."""

LIMITS = (-0.026, 0.018)
"""P of both pressure maps, as one colour scale."""


def pressure_map(path, solution):
    """Figures 7 and 8: the pressure over the pad."""
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(figsize=(6.2, 3.9), layout="constrained")
        image = wedge_picture.pressure_map(axes, solution.mesh, solution.fields, LIMITS)
        figure.colorbar(image, ax=axes, label="P = m$^2$p/($\\eta$u), 1/mm", extend="both")
        axes.set_title(f"{solution.contact.pillar} pillar (grey); the film moves towards small X")
        figure.savefig(path)
        plt.close(figure)


def center_lines(path, solutions):
    """Figure 9: all four cases on Y = 0, the blocked exit's series as marks."""
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(figsize=(6.8, 4.4), layout="constrained")
        for shape, colour in COLOURS.items():
            style = "--" if shape == "no blockage" else "-"
            axes.plot(
                *center_line(solutions[shape].mesh, solutions[shape].fields),
                style,
                color=colour,
                label=shape,
            )
        X = np.linspace(20.0, 48.0, 15)
        series = WedgeSeries(20.0, 50.0, 20.0, True)
        label = "blocked exit, series"
        axes.plot(X, series.pressure(X), "s", color=COLOURS["blocked exit"], markersize=4, label=label)
        _finish(axes, "Figure 9: pressure on Y = 0")
        figure.savefig(path)
        plt.close(figure)


def untreated(path, solutions):
    """Figure 10: what an untreated Couette flow does, in both orientations."""
    with plt.rc_context(STYLE):
        figure, panels = plt.subplots(1, 2, figsize=(11.5, 4.4), layout="constrained")
        titles = ("(a) film moves against the differencing", "(b) turned: with the differencing")
        for axes, turned, title in zip(panels, ("", ", turned"), titles, strict=True):
            for shape in ("square pillar", "cylindrical pillar"):
                for case, style, label in (("", "-", shape), (", untreated", "--", f"{shape}, NTCF")):
                    solution = solutions[f"{shape}{turned}{case}"]
                    line = center_line(solution.mesh, solution.fields)
                    axes.plot(*line, style, color=COLOURS[shape], label=label)
            _finish(axes, title)
        figure.suptitle("Figure 10: scheme 1B with and without treatment of the Couette flow (NTCF)")
        figure.savefig(path)
        plt.close(figure)


def _finish(axes, title):
    axes.axhline(0.0, color="0.8", linewidth=0.8, zorder=0)
    axes.set(xlabel="X, mm", ylabel="P = m$^2$p/($\\eta$u), 1/mm", title=title)
    axes.legend(frameon=False)
