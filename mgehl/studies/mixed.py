"""Rough balls drawn at random, from full film to boundary lubrication: how many are solved, by what work.

Roughness, load and speed are drawn by their logarithms, Hurst's exponent evenly; each case has a surface of
its own. Each case is solved for itself: no case starts from another.
"""

import numpy as np

from mgehl.studies.chance import BALL, Drawn, answer, by_logarithm, run_drawn
from mgehl.studies.columns import told
from mgehl.studies.study import merged

NODES, CASES = 257, 120

RMS, HURST = (20e-9, 400e-9), (0.5, 0.9)
"""From, to: roughness in m, Hurst's exponent."""

LOAD, SPEED = (20.0, 800.0), (1e-5, 1.0)
"""From, to: N, m/s."""

COMMON = {"surface": {"shortest_wavelength": 30e-6}, "solver": {"error": False}}
"""What all cases have besides; there is no boundary film."""


def run(study):
    """Solve all; write the tables `mixed` and `mixed-summary`."""
    run_drawn(study, "mixed", draw, row, NODES, CASES)


def draw(cases, seed):
    """So many `Drawn`. A longer list begins with the same cases."""
    chance = np.random.default_rng(seed)
    return [_drawn(chance, number) for number in range(1, cases + 1)]


def _drawn(chance, number):
    rms, load, speed = (by_logarithm(chance, *ends) for ends in (RMS, LOAD, SPEED))
    surface = {"rms": rms, "hurst": float(chance.uniform(*HURST)), "seed": number}
    own = {"contact": {"load": load}, "motion": {"speed": speed}, "surface": surface}
    what = f"{1e9 * rms:.0f} nm, {load:.0f} N, {1e3 * speed:.3g} mm/s"
    return Drawn(number, what, merged(BALL, own, COMMON))


def row(case, solution):
    """Text of one case."""
    tables = case.tables
    return {
        "case": str(case.number),
        "rms nm": f"{1e9 * tables['surface']['rms']:.1f}",
        "load N": f"{tables['contact']['load']:.1f}",
        "speed mm/s": f"{1e3 * tables['motion']['speed']:.4g}",
        "Hurst": f"{tables['surface']['hurst']:.3f}",
        **told(solution.result, "lambda"),
        **answer(solution.result),
    }
