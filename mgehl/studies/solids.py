"""From which lambda on solids carry load: two ground surfaces at rest, and two that roll and slide.

At rest the surfaces stand still while the oil is drawn through; in motion each goes along with its body,
and means over passages are told. The oil is Newtonian, or thinned by shear.
"""

from math import sqrt

import numpy as np

from mgehl.output.pictures.style import COLOURS, subplots
from mgehl.studies.chance import BALL
from mgehl.studies.columns import told
from mgehl.studies.limits import number_of
from mgehl.studies.study import merged

NODES, SPEEDS = 65, (0.1, 0.03, 0.015, 0.008, 0.003, 0.001)
"""Speeds in m/s: lambda 1 to .04."""

SURFACE = {"kind": "self-affine", "rms": 70e-9, "hurst": 0.8, "shortest_wavelength": 30e-6,
           "longest_wavelength": 200e-6}  # fmt: skip

CASE = merged(
    BALL,
    {
        "contact": {"load": 20.0, "boundary_film": 2e-9},
        "surface": SURFACE | {"seed": 1},
        "second_surface": SURFACE | {"seed": 2},
        "motion": {"slide_to_roll": 0.2},
    },
)  # fmt: skip

MOVING = {"surface": {"body": "body_1"}, "second_surface": {"body": "body_2"}}

PASSAGES, HERTZ = 10.0, 0.24e-3
"""Passages after which a run ends if its means have not settled before, and their length in m."""

EYRING = {"friction": {"model": "eyring", "eyring_stress": 5e6}}
"""A round number within what is measured of mineral oils."""

OILS = {"Newtonian": {}, "Eyring": EYRING}
MOTIONS = {"at rest": {}, "moving": MOVING}

CARRIED = 0.001, 0.01, 0.1
"""Parts of the load for which lambda is told."""


def run(study):
    """Solve all; write the tables `solids` and `solids-begin`, and the picture `solids`."""
    (nodes,) = study.asked.nodes or (NODES,)
    asked = [(oil, motion, speed) for motion in MOTIONS for oil in OILS for speed in SPEEDS]
    cases = {f"{oil}, {motion}, {speed:g} m/s": (oil, motion, speed) for oil, motion, speed in asked}
    tables = {name: case(nodes, *how) for name, how in cases.items()}
    results = {cases[name]: solution.result for name, solution in study.solved(tables)}
    study.write_table("solids", [row(*how, result) for how, result in results.items()])
    curves = {name: _curve(results, *name) for name in dict.fromkeys(how[:2] for how in asked)}
    study.write_table("solids-begin", [begin(*name, *curve) for name, curve in curves.items()])
    study.draw("solids", figure, curves)


def case(nodes, oil, motion, speed):
    """The tables of a case."""
    tables = merged(
        CASE, OILS[oil], MOTIONS[motion], {"grid": {"nodes": nodes}, "motion": {"speed": speed}}
    )
    if motion == "at rest":
        return tables
    return merged(tables, {"time": {"end": PASSAGES * HERTZ / speed, "until": "settled"}})


def row(oil, motion, speed, result):
    """Text of a case."""
    found = {"oil": oil, "surfaces": motion, "speed mm/s": f"{1e3 * speed:g}"}
    found["lambda"] = f"{lambda_of(result):.3g}"
    for name in ("load_on_solids", "load_on_contact", "mean_gap_nm"):
        value, band = _mean(result, name)
        found |= {name.replace("_", " "): f"{value:.4g}", "band of " + name.replace("_", " "): band}
    return found | told(result, "steps, convolutions, converged")


def lambda_of(result):
    """The film of smooth bodies over the rms of both surfaces: what of them lies within the Hertz ellipse
    has another one in each instant."""
    return result.mixed.lambda_ratio * result.mixed.Sq_nm / (sqrt(2.0) * 1e9 * SURFACE["rms"])


def _mean(result, name):
    """A mean over passages and its band as text; of surfaces at rest the number itself."""
    if result.time:
        mean = result.time.means.get(name)
        apart = mean and mean.between_passages
        return (mean.value, "" if apart is None else f"{apart:.2g}") if mean else (np.nan, "")
    return number_of(name, result), ""


def _curve(results, oil, motion):
    """lambda and load on solids of what has converged and touches, from thin to thick films."""
    points = sorted(
        (lambda_of(result), _mean(result, "load_on_solids")[0])
        for (own, moved, _), result in results.items()
        if (own, moved) == (oil, motion) and result.converged
    )
    return np.array([each for each in points if each[1] > 0.0]).reshape(-1, 2).T


def begin(oil, motion, ratio, solids):
    """From which lambda on solids carry some parts of the load, between two points by logarithms."""
    found = {"oil": oil, "surfaces": motion}
    for part in CARRIED:
        seen = solids.size > 1 and solids[-1] < part < solids[0]
        log = np.interp(-np.log(part), -np.log(solids), np.log(ratio)) if seen else np.nan
        found[f"lambda at {100 * part:g} %"] = f"{np.exp(log):.3g}" if seen else ""
    return found


def figure(curves):
    """Load on solids against lambda."""
    figure, axis = subplots(1, size=(6.4, 4.6))
    strokes = {"at rest": "--o", "moving": "-s"}
    for (oil, motion), (ratio, solids) in curves.items():
        colour = COLOURS[list(OILS).index(oil)]
        axis.plot(ratio, solids, strokes[motion], color=colour, label=f"{oil}, {motion}")
    axis.set(xscale="log", xlabel="lambda: film of smooth bodies over the rms of both surfaces")
    axis.set(yscale="log", ylabel="part of the load on solids")
    axis.legend()
    return figure
