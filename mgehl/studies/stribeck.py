"""Stribeck curves: a ball on a ground disc that roll and slide, by three oils over three decades of speed.

Each oil is a sweep of its own, from the fastest speed on. The oils are those of `mgehl.model.oils` at 60
degrees C; their limit and Eyring stress are round numbers within what is measured of such oils.
"""

from mgehl.model.oils import OILS
from mgehl.output.pictures.curves import curves
from mgehl.studies.chance import BALL
from mgehl.studies.points import axis_of, points_of
from mgehl.studies.study import merged
from mgehl.studies.sweep import fill

NODES, SPEEDS = 129, "0.3..3e-4 m/s:10"

CASE = merged(
    BALL,
    {
        "contact": {"load": 50.0, "boundary_film": 2e-9},
        "surface": {"rms": 100e-9, "hurst": 0.8, "shortest_wavelength": 50e-6, "seed": 1},
        "lubricant": {"temperature": "60 degC", "conductivity": 0.14},
        "motion": {"slide_to_roll": 0.2},
        "friction": {"model": "limiting", "limiting_coefficient": 0.05, "eyring_stress": 5e6,
                     "boundary_coefficient": 0.1},
        "heat": {"conductivity_1": 46.0, "conductivity_2": 46.0, "capacity_1": 3.6e6, "capacity_2": 3.6e6},
        "solver": {"error": True},
    },
)  # fmt: skip


def run(study):
    """Solve all; write a table, arrays and curves of each oil, and the picture `stribeck` of all."""
    (nodes,) = study.asked.nodes or (NODES,)
    told = []
    for oil in OILS:
        config = study.config(merged(CASE, {"grid": {"nodes": nodes}, "lubricant": {"oil": oil}}))
        axes = [axis_of(config, "motion.speed", SPEEDS)]
        points = points_of(config, axes)
        study.expected = len(OILS) * len(points)
        told += fill(study, study.home / oil, axes, points, f"stribeck-{oil}")
    study.draw("stribeck", curves, told, "motion.speed")
