"""Rough balls drawn at random, from full film to boundary lubrication: how many are solved, by what work.

Roughness, load and speed are drawn by their logarithms, Hurst's exponent evenly; each case has a surface of
its own. Each case is solved for itself: no case starts from another.
"""

import numpy as np

from mgehl.studies.chance import HURST, RMS, Drawn, answer, ball, by_logarithm, run_drawn, said_of_ball
from mgehl.studies.study import merged

NODES, CASES = 257, 120

LOAD, SPEED = (20.0, 800.0), (1e-5, 1.0)
"""From, to: N, m/s."""

COMMON = {"surface": {"shortest_wavelength": 30e-6}, "solver": {"start": "film", "error": False}}
"""What all cases have besides; there is no boundary film."""


def run(study):
    """Solve all; write the tables `mixed` and `mixed-summary`."""
    run_drawn(study, "mixed", draw, row, NODES, CASES)


def draw(cases, seed):
    """So many `Drawn`. A longer list begins with the same cases."""
    chance, drawn = np.random.default_rng(seed), []
    for number in range(1, cases + 1):
        rms, load, speed = (by_logarithm(chance, *ends) for ends in (RMS, LOAD, SPEED))
        tables = ball(number, rms, load, speed, float(chance.uniform(*HURST)))
        drawn.append(Drawn(number, said_of_ball(rms, load, speed), merged(tables, COMMON)))
    return drawn


def row(case, solution):
    """Text of one case."""
    tables = case.tables
    return {
        "case": str(case.number),
        "rms nm": f"{1e9 * tables['surface']['rms']:.1f}",
        "load N": f"{tables['contact']['load']:.1f}",
        "speed mm/s": f"{1e3 * tables['motion']['speed']:.4g}",
        "Hurst": f"{tables['surface']['hurst']:.3f}",
        "lambda": f"{solution.result.mixed.lambda_ratio:.3g}",
        **answer(solution.result),
    }
