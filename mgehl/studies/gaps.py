"""Bands about the mean gaps of rough balls drawn at random, beside a grid twice as fine: do they hold?

Roughness, load and speed are drawn by their logarithms, Hurst's exponent evenly, the shortest wave and the
boundary film from a few. Each case has a surface of its own.
"""

from math import nan

import numpy as np

from mgehl.studies.bands import Band, cells, summary, work_of_band
from mgehl.studies.chance import HURST, RMS, Drawn, ball, by_logarithm, drawn_of, said_of_ball
from mgehl.studies.study import merged, yes

NODES, CASES = (257, 513), 40

LOAD, SPEED = (20.0, 500.0), (5e-5, 0.1)
"""From, to: N, m/s."""
SHORTEST, LAYERS = (30e-6, 40e-6, 60e-6), (0.0, 1e-9, 2e-9, 5e-9)
"""Wavelengths and boundary films, in m."""

GAPS = {"mean": "mean gap", "loaded": "by pressure"}
"""The two gaps that have bands, and what tables call them."""


def run(study):
    """Solve all on both grids, with bands on the coarser; write the tables `gaps` and `gaps-summary`."""
    coarse, fine = study.nodes or NODES
    drawn = drawn_of(study, draw, CASES)
    study.cases = 2 * len(drawn)
    rows, bands = [], {name: [] for name in GAPS.values()}
    for case in drawn:
        grids = {n: {"grid": {"nodes": n}, "solver": {"error": n == coarse}} for n in (coarse, fine)}
        tables = {f"{case.title}, {n} nodes": merged(case.tables, own) for n, own in grids.items()}
        found = [each.result for _, each in study.solved(tables, must_converge=False, with_fields=False)]
        if len(found) == 2:
            own = {name: band_of(gap, *found) for gap, name in GAPS.items()}
            rows.append(_row(case, *found, own))
            for name, band in own.items():
                bands[name].append(band)
    study.write_table("gaps", rows)
    study.write_table("gaps-summary", list(summary(bands)))


def draw(cases, seed):
    """So many `Drawn`. A longer list begins with the same cases."""
    chance, drawn = np.random.default_rng(seed), []
    for number in range(1, cases + 1):
        rms, load, speed = (by_logarithm(chance, *ends) for ends in (RMS, LOAD, SPEED))
        hurst = float(chance.uniform(*HURST))
        shortest, layers = float(chance.choice(SHORTEST)), float(chance.choice(LAYERS))
        tables = ball(number, rms, load, speed, hurst, shortest_wavelength=shortest)
        own = {"contact": {"boundary_film": layers}, "solver": {"start": "film"}}
        what = f"{said_of_ball(rms, load, speed)}, layers {1e9 * layers:g} nm"
        drawn.append(Drawn(number, what, merged(tables, own)))
    return drawn


def band_of(gap, coarse, fine):
    """The `Band` of a gap on the coarser grid, its limit by Richardson; NaN without a finer answer."""
    value, finer = (getattr(each.mixed, f"{gap}_gap_nm") for each in (coarse, fine))
    error = coarse.mixed.error
    limit = finer + (finer - value) / 3.0 if fine.settled else nan
    return Band(value, getattr(error, f"{gap}_nm") if error else None, limit)


def _row(case, coarse, fine, bands):
    """Text of one case on both grids."""
    mixed = coarse.mixed
    row = {
        "case": case.title,
        "lambda": f"{mixed.lambda_ratio:.3g}",
        "inlet cells": f"{coarse.resolution.inlet_cells:.2f}",
        "converged": " ".join(yes(each.converged) for each in (coarse, fine)),
    }
    for name, band in bands.items():
        row |= cells(name, band)
    return row | {
        "load on contact %": f"{100 * mixed.contact_load_share:.2f}",
        "near contact %": f"{100 * mixed.near_contact_load_share:.2f}",
        "load on contact % of the finer grid": f"{100 * fine.mixed.contact_load_share:.2f}",
        "convolutions": f"{coarse.work.convolutions:.1f}",
        **work_of_band(coarse, mixed.error),
    }
