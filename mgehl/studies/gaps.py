"""Bands about the mean gaps of rough balls drawn at random, beside a grid twice as fine: do they hold?

Roughness, load and speed are drawn by their logarithms, Hurst's exponent evenly, the shortest wave and the
boundary film from a few. Each case has a surface of its own.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.studies.rough_ball import BALL, HURST, RMS, DrawnBall, by_logarithm
from mgehl.studies.study import merged, statistic

NODES, CASES, SEED = (257, 513), 40, 7

LOAD, SPEED = (20.0, 500.0), (5e-5, 0.1)
"""From, to: N, m/s."""
SHORTEST, LAYERS = (30e-6, 40e-6, 60e-6), (0.0, 1e-9, 2e-9, 5e-9)
"""Wavelengths and boundary films, in m."""

GAPS = {"mean": "mean gap", "loaded": "by pressure"}
"""The two gaps that have bands, and what tables call them."""


@dataclass(frozen=True)
class Drawn(DrawnBall):
    """A ball with a shortest wave and layers of its own, in m."""

    shortest: float
    layers: float

    @property
    def title(self):
        return f"{self.number}: {super().title}, layers {1e9 * self.layers:g} nm"

    def tables(self, nodes, error):
        """Its configuration, with bands or without."""
        own = {
            "contact": {"load": self.load, "boundary_film": self.layers},
            "surface": {
                "rms": self.rms,
                "hurst": self.hurst,
                "shortest_wavelength": self.shortest,
                "seed": self.number,
            },
            "motion": {"speed": self.speed},
            "grid": {"nodes": nodes},
            "discretization": {"couette": "3L", "face_mobility": "linear-gap"},
            "solver": {"start": "film", "error": error},
        }
        return merged(BALL, own)


def run(study):
    """Solve all on both grids; write the tables `gaps` and `gaps-summary`."""
    nodes = study.nodes or NODES
    drawn = draw(study.wanted or CASES, SEED if study.seed is None else study.seed)
    study.cases = 2 * len(drawn)
    rows = [_row_of(study, case, nodes) for case in drawn]
    study.write_table("gaps", rows)
    study.write_table("gaps-summary", summary(rows))


def draw(cases, seed):
    """So many `Drawn`. A longer list begins with the same cases."""
    chance, drawn = np.random.default_rng(seed), []
    for number in range(1, cases + 1):
        rms, load, speed = (by_logarithm(chance, *ends) for ends in (RMS, LOAD, SPEED))
        hurst, shortest, layers = chance.uniform(*HURST), chance.choice(SHORTEST), chance.choice(LAYERS)
        drawn.append(Drawn(number, rms, load, speed, float(hurst), float(shortest), float(layers)))
    return drawn


def _row_of(study, case, nodes):
    """Text of one case."""
    coarse, fine = (
        study.solve(f"{case.title}, {n} nodes", case.tables(n, n == nodes[0]), False).result for n in nodes
    )
    mixed = coarse.mixed
    return {
        "case": case.title,
        "lambda": f"{mixed.lambda_ratio:.3g}",
        "inlet cells": f"{coarse.resolution.inlet_cells:.2f}",
        "converged": " ".join("yes" if each.converged else "no" for each in (coarse, fine)),
        **{
            f"{name}{what}": text
            for gap, name in GAPS.items()
            for what, text in _band(gap, coarse, fine).items()
        },
        "load on contact %": f"{100 * mixed.contact_load_share:.2f}",
        "near contact %": f"{100 * mixed.near_contact_load_share:.2f}",
        "load on contact % of the finer grid": f"{100 * fine.mixed.contact_load_share:.2f}",
        "convolutions": f"{coarse.work.convolutions:.1f}",
        "of the band": f"{mixed.error.convolutions:.1f}" if mixed.error else "",
    }


def _band(gap, coarse, fine):
    """A gap on both grids, its limit by Richardson, and its band; empty where there is none to judge."""
    values = [getattr(each.mixed, f"{gap}_gap_nm") for each in (coarse, fine)]
    error = coarse.mixed.error
    band = getattr(error, f"{gap}_nm") if error else None
    known = band is not None and fine.settled
    limit = values[1] + (values[1] - values[0]) / 3.0
    off = abs(limit - values[0])
    return {
        " nm": f"{values[0]:.4g}",
        " limit nm": f"{limit:.4g}" if known else "",
        " off by %": f"{100.0 * off / values[0]:.2f}" if known else "",
        " band %": f"{100.0 * band / values[0]:.2f}" if known else "",
        " holds": ("yes" if off <= band else "no") if known else "",
    }


def summary(rows):
    """Rows of the summary: how many bands hold, how wide they are, and their work."""
    good = [row for row in rows if row["converged"].startswith("yes")]
    numbers = {"cases": str(len(rows)), "converged on the coarser grid": str(len(good))}
    for name in GAPS.values():
        judged = [row for row in rows if row[f"{name} holds"]]
        held = sum(row[f"{name} holds"] == "yes" for row in judged)
        numbers[f"{name}: bands that hold"] = f"{held} of {len(judged)}"
        numbers[f"{name}: band, median %"] = _median(float(row[f"{name} band %"]) for row in judged)
        numbers[f"{name}: band over error, median"] = _median(
            float(row[f"{name} band %"]) / max(float(row[f"{name} off by %"]), 0.01) for row in judged
        )
    shares = (float(row["of the band"]) / float(row["convolutions"]) for row in rows if row["of the band"])
    numbers["work of the bands, median part of the run's"] = _median(shares)
    return [{"what": what, "value": value} for what, value in numbers.items()]


def _median(values):
    return statistic(np.median, values, "{:.2f}")
