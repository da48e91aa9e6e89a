"""Rough balls on two grids by schemes of the Couette flow, beside a finer grid: how much of film and load
on contact is the grid's."""

from dataclasses import dataclass

import numpy as np

from mgehl.studies.rough_ball import BALL
from mgehl.studies.study import merged, statistic

NODES = 257, 513
"""The grids of all schemes. The next finer one is what they are compared with, by `COMPARED_WITH`."""

SCHEMES = ("1B", "3L")
COMPARED_WITH = "3L"
"""1B is far from its limit there still (`configs/rough.toml`: 10 % of the load on contact where 3B and 3L
have 17 %)."""

COMMON = merged(
    BALL, {"surface": {"hurst": 0.8, "shortest_wavelength": 40e-6}, "solver": {"start": "film"}}
)
"""What all cases have in common."""


@dataclass(frozen=True)
class Ball:
    """A rough ball: N, nm, mm/s, nm; `seed` is that of its surface."""

    load: float
    rms: float
    speed: float
    layers: float
    seed: int

    @property
    def name(self):
        return f"{self.load:g} N, {self.rms:g} nm, {self.speed:g} mm/s, layers {self.layers:g} nm"

    def tables(self, nodes, couette):
        """Its configuration."""
        own = {
            "contact": {"load": self.load, "boundary_film": 1e-9 * self.layers},
            "surface": {"rms": 1e-9 * self.rms, "seed": self.seed},
            "motion": {"speed": 1e-3 * self.speed},
            "grid": {"nodes": nodes},
            "discretization": {"couette": couette, "face_mobility": "linear-gap"},
        }
        return merged(COMMON, own)


BALLS = (
    Ball(20, 50, 5, 0, 1), Ball(20, 100, 1, 0, 2), Ball(50, 100, 3, 0, 3), Ball(100, 200, 10, 0, 4),
    Ball(20, 100, 0.6, 2, 1), Ball(20, 50, 0.3, 2, 2), Ball(50, 200, 1, 2, 4), Ball(20, 200, 2, 2, 6),
)  # fmt: skip


def run(study):
    """Solve all; write the tables `balls` and `summary`."""
    nodes = study.nodes or NODES
    study.cases = len(BALLS) * (1 + len(nodes) * len(SCHEMES))
    rows = [row for ball in BALLS for row in _rows_of_ball(study, ball, nodes)]
    study.write_table("balls", rows)
    study.write_table("summary", [_summary(rows, scheme, n) for n in nodes for scheme in SCHEMES])


def _rows_of_ball(study, ball, nodes):
    """Every scheme on every grid beside the finest."""
    most = 2 * nodes[-1] - 1
    finest = _solve(study, ball, most, COMPARED_WITH)
    return [
        _row(ball, most, COMPARED_WITH, finest, finest),
        *(_row(ball, n, each, _solve(study, ball, n, each), finest) for n in nodes for each in SCHEMES),
    ]


def _solve(study, ball, nodes, couette):
    return study.solve(f"{ball.name}, {couette}, {nodes} nodes", ball.tables(nodes, couette), False).result


def _row(ball, nodes, couette, result, finest):
    mixed, beside = result.mixed, finest.mixed
    known = result.converged and finest.converged
    return {
        "ball": ball.name,
        "nodes": str(nodes),
        "couette": couette,
        "converged": "yes" if result.converged else "no",
        "inlet cells": f"{result.resolution.inlet_cells:.2f}",
        "mean film nm": f"{mixed.mean_film_nm:.3f}",
        "off by %": f"{100.0 * (mixed.mean_film_nm / beside.mean_film_nm - 1.0):.1f}" if known else "",
        "load on contact %": f"{100.0 * mixed.contact_load_share:.2f}",
        "off by points": _points(mixed, beside) if known else "",
        "convolutions": f"{result.work.convolutions:.1f}",
    }


def _points(mixed, beside):
    """By how many hundredths of the load another part of it is on contact."""
    return f"{100.0 * (mixed.contact_load_share - beside.contact_load_share):.2f}"


def _summary(rows, scheme, nodes):
    """Errors of a scheme on a grid over all balls, of the load over those that touch, and its work."""
    which = {"couette": scheme, "nodes": str(nodes)}
    found = [row for row in rows if which.items() <= row.items()]
    touching = [row for row in found if float(row["load on contact %"]) > 0.0]
    return which | {
        "converged": f"{sum(row['converged'] == 'yes' for row in found)} of {len(found)}",
        "mean film: median error %": statistic(np.median, _sizes("off by %", found)),
        "largest": statistic(np.max, _sizes("off by %", found)),
        "load on contact: median error in points": statistic(np.median, _sizes("off by points", touching)),
        "largest in points": statistic(np.max, _sizes("off by points", touching)),
        "convolutions, mean": f"{np.mean([float(row['convolutions']) for row in found]):.0f}",
    }


def _sizes(name, rows):
    return [abs(float(row[name])) for row in rows if row[name]]
