"""Stribeck curves: a ball on a ground disc that roll and slide, by three oils over three decades of speed.

Each oil is a sweep of its own, from the fastest speed on. The oils are those of `mgehl.model.oils` at 60
degrees C; their limit and Eyring stress are round numbers within what is measured of such oils.
"""

from math import isfinite

import numpy as np

from mgehl.model.oils import OILS
from mgehl.output.pictures.style import COLOURS, applied, legend_under_all, save, subplots
from mgehl.output.quantities import QUANTITIES
from mgehl.run import Watch
from mgehl.studies.chance import BALL
from mgehl.studies.study import merged
from mgehl.studies.sweep import axis_of, fill, points_of

NODES, SPEEDS = 129, "0.3..3e-4 m/s:10"

CASE = merged(
    BALL,
    {
        "contact": {"load": 50.0, "boundary_film": 2e-9},
        "surface": {"rms": 100e-9, "hurst": 0.8, "shortest_wavelength": 50e-6, "seed": 1},
        "lubricant": {"temperature": "60 degC"},
        "motion": {"slide_to_roll": 0.2},
        "friction": {"model": "limiting", "limiting_coefficient": 0.05, "eyring_stress": 5e6,
                     "boundary_coefficient": 0.1},
        "solver": {"start": "film", "error": True},
    },
)  # fmt: skip

MIXED, BOUNDARY = 0.01, 0.5
"""Part of the load on solids from which on the regime is called mixed, and boundary lubrication."""

PARTS = {"friction": ("-o", "friction"), "friction_of_film": ("--", "of the film"),
         "friction_of_solids": (":", "of solids")}  # fmt: skip
PANELS = {"friction coefficient": PARTS, "part of the load on solids": {"load_on_solids": ("-o", "")},
          "mean gap, nm": {"mean_gap_nm": ("-o", "")}}  # fmt: skip


def run(study):
    """Solve all; write a table and arrays of each oil, and the picture `stribeck`."""
    (nodes,) = study.nodes or (NODES,)
    axes, found = [], {}
    for oil in OILS:
        config = study.config(merged(CASE, {"grid": {"nodes": nodes}, "lubricant": {"oil": oil}}))
        axes = [axis_of(config, "motion.speed", SPEEDS)]
        points = points_of(config, axes)
        study.cases = len(OILS) * len(points)
        found[oil] = fill(study, study.home / oil, axes, points, Watch(), f"stribeck-{oil}")
    study.draw("stribeck", curves, found)


def curves(path, found):
    """Friction with its parts, load on solids and mean gap against speed, {oil: `Told` runs}; bands are
    shaded, and so are, on the first panel, the regimes of the first oil."""
    with applied():
        figure, axes = subplots(3, size=(6.4, 9.0), sharex=True)
        for (oil, runs), colour in zip(found.items(), COLOURS, strict=False):
            runs = sorted(
                (each for each in runs if each.settled), key=lambda each: each.value("motion.speed")
            )
            speed = [each.value("motion.speed") for each in runs]
            for axis, shown in zip(axes, PANELS.values(), strict=True):
                for name, (stroke, said) in shown.items():
                    where, _, _, band = QUANTITIES[name]
                    y = np.array([each.number(where) for each in runs])
                    label = oil if said in ("", "friction") else said if colour == COLOURS[0] else None
                    axis.plot(speed, y, stroke, color=colour, markersize=3, label=label)
                    width = np.array([each.number(band or "none") for each in runs])
                    axis.fill_between(
                        speed, np.maximum(y - width, 0.0), y + width, color=colour, alpha=0.2, linewidth=0
                    )
        _mark_regimes(axes[0], found)
        for axis, label in zip(axes, PANELS, strict=True):
            axis.set(xscale="log", ylabel=label)
        axes[2].set(yscale="log", xlabel="entrainment speed, m/s")
        axes[0].set_ylim(bottom=0.0)
        legend_under_all(figure, axes[0].get_legend_handles_labels()[0])
        save(figure, path)


def _mark_regimes(axis, found):
    """Lines where solids of the first oil begin to carry `MIXED` and `BOUNDARY` of the load."""
    oil, runs = next(iter(found.items()))
    where = QUANTITIES["load_on_solids"].path
    told = sorted((each.value("motion.speed"), each.number(where)) for each in runs if each.settled)
    told = [(speed, share) for speed, share in told if isfinite(share)]
    for share, words in ((MIXED, f"mixed ({oil})"), (BOUNDARY, "boundary")):
        slower = [speed for speed, carried in told if carried >= share]
        if slower and len(slower) < len(told):
            axis.axvline(max(slower), color="0.6", linewidth=0.8, zorder=0)
            axis.annotate(words, (max(slower), 1.0), (-3, -3), xycoords=("data", "axes fraction"),
                          textcoords="offset points", ha="right", va="top", fontsize="small")  # fmt: skip
