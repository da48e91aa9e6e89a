"""A rough contact from full film to nearly dry: load share, contact area, patches and film by speed.

Each speed is solved from a film and from contact, and never from another speed. Where both lead to the same
state, that state does not depend on the start.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.mesh import Mesh
from mgehl.model.load_share import aihara, error_function, zhou_hoeprich
from mgehl.studies.rough_ball import BALL
from mgehl.studies.study import merged, verdict

NODES = 257
FASTEST, SLOWEST, COUNT = 1.0, 1e-5, 20
"""m/s."""

BOUNDARY_FILM = 2e-9
"""m: that of adsorbed layers, where no other is asked for."""

STARTS = ("film", "contact")

SHOWN = 4
"""States in the picture of states."""

CASE = merged(
    BALL,
    {
        "contact": {"load": 100.0},
        "surface": {"rms": 100e-9, "hurst": 0.8, "shortest_wavelength": 30e-6, "seed": 1},
        "discretization": {"couette": "3L", "face_mobility": "linear-gap"},
    },
)
"""All speeds are solved by one scheme, which keeps a film behind peaks."""

FITS = {"Aihara": aihara, "Zhou-Hoeprich": zhou_hoeprich, "1 - erf": error_function}


@dataclass(frozen=True)
class Point:
    """A speed solved from one start; the maps are for pictures, (ny, nx) on rank 0, None elsewhere."""

    speed: float
    start: str
    result: object
    mesh: Mesh
    film: np.ndarray | None
    """In nm."""
    status: np.ndarray | None

    @property
    def film_ratio(self):
        """lambda, from which the fits tell the load share."""
        return self.result.mixed.lambda_ratio


def run(study):
    """Solve all; write the table `rough` and the pictures `load-share` and `states`."""
    (nodes,) = study.nodes or (NODES,)
    study.cases = COUNT * len(STARTS)
    ways = {}
    for speed in speeds():
        for start in STARTS:
            ways.setdefault(speed, []).append(_solve(study, nodes, speed, start))
    points = [point for both in ways.values() for point in both]
    study.write_table("rough", [row(point, ways[point.speed]) for point in points])
    from mgehl.studies import rough_figures as figures

    study.draw("load-share", figures.load_share, points, FITS)
    shown = chosen(ways)
    if shown:
        study.draw("states", figures.states, shown)


def speeds():
    """Fast to slow, m/s."""
    return [float(f"{speed:.4g}") for speed in np.geomspace(FASTEST, SLOWEST, COUNT)]


def case(nodes, speed, start, boundary_film):
    """The tables of a point."""
    own = {
        "contact": {"boundary_film": boundary_film},
        "grid": {"nodes": nodes},
        "motion": {"speed": speed},
        "solver": {"start": start},
    }
    return merged(CASE, own)


def _solve(study, nodes, speed, start):
    title = f"{speed:g} m/s from {start}"
    boundary_film = BOUNDARY_FILM if study.boundary_film is None else study.boundary_film
    solution = study.solve(title, case(nodes, speed, start, boundary_film))
    film, status = None, solution.status
    if status is not None:
        film = (1e9 * solution.film).astype(np.float32)
    return Point(speed, start, solution.result, solution.mesh, film, status)


def chosen(ways):
    """Up to `SHOWN` of the speeds that converged, from fast to slow; from a film, if that way did."""
    found = [[point for point in both if point.result.converged] for both in ways.values()]
    first = [both[0] for both in found if both]
    at = np.linspace(0, len(first) - 1, min(SHOWN, len(first))).round().astype(int)
    return [first[k] for k in at]


def row(point, both):
    """Text of one point; numbers of what converged only."""
    result, mixed = point.result, point.result.mixed
    cells = {
        "speed mm/s": f"{1e3 * point.speed:.4g}",
        "start": point.start,
        "lambda": f"{point.film_ratio:.4g}",
        **(_numbers(mixed) if result.converged else dict.fromkeys(_numbers(mixed), "")),
        "load on contact apart from the other start": _difference(both),
    }
    cells |= {name: f"{fit(point.film_ratio):.4f}" for name, fit in FITS.items()}
    return cells | {
        "nodes in the shortest wave": f"{result.resolution.surface_nodes:.1f}",
        "convolutions": f"{result.work.convolutions:.0f}",
        "steps": str(result.work.steps),
        "verdict": verdict(result),
    }


def _numbers(mixed):
    return {
        "load on contact": f"{mixed.contact_load_share:.4g}",
        "contact/Hertz area": f"{mixed.contact_area_over_hertz:.4g}",
        "contact area um^2": f"{1e12 * mixed.contact_area_m2:.1f}",
        "patches": str(mixed.patches),
        "largest patch um^2": f"{1e12 * mixed.largest_patch_m2:.1f}",
        "minimum film nm": _film(mixed.minimum_film_nm),
        "mean film nm": _film(mixed.mean_film_nm),
        "film in valleys nm": _film(mixed.valley_film_nm),
        "mean gap nm": f"{mixed.mean_gap_nm:.4f}",
        "gap by pressure nm": f"{mixed.loaded_gap_nm:.4f}",
        "torn": f"{mixed.torn_share:.4f}",
    }


def _film(nm):
    return "none" if nm is None else f"{nm:.3f}"


def _difference(both):
    """How far apart the load shares of both starts are; empty unless both converged."""
    if not all(point.result.converged for point in both):
        return ""
    shares = [point.result.mixed.contact_load_share for point in both]
    return f"{abs(shares[0] - shares[1]):.1e}"
