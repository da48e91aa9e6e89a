"""Results and solutions made by hand for the tests of files and words: few nodes, no two of them alike."""

import numpy as np

from mgehl.config import config_from_tables
from mgehl.discretization.mesh import Mesh
from mgehl.kinds import contact_from
from mgehl.output.mixed_result import MixedResult
from mgehl.output.result import ContactResult, Overlap, Resolution, Result, TimeResult, Work
from mgehl.output.solution import Fields, Solution
from mgehl.solver.inequality import Inequality

TABLES = {
    "point": {"contact": {"radius_y": 25.4e-3}, "motion": {"speed": 0.5}},
    "line": {"contact": {"kind": "line"}, "motion": {"speed": 0.5}},
    "wedge": {"contact": {"kind": "wedge"}},
}
SHAPES = {"point": (5, 7), "line": (1, 7), "wedge": (5, 7)}


def make_result(**changes):
    """A `Result` of a point contact with a film and contact, but for some parts."""
    values = {
        "converged": True, "reason": "all holds", "central_film_nm": 12.0, "minimum_film_nm": 1.0,
        "max_pressure_GPa": 2.3, "residual": 1e-9, "load_error": -1e-10, "complementarity_error": 0.0,
        "settled": True, "contradictions": [], "flux_imbalance": 1e-11,
        "contact": ContactResult(3, 0.01, 0.02, (4, 6), None, 0.0),
        "overlap": Overlap(0, 0.0),
        "pressure_inequality": Inequality(8, 1, 0.25, 1.5, [{"i": 6, "j": 3, "size": 0.25}]),
        "other_inequality": Inequality(8, 0, 0.0, 0.0, [], "at the interface"),
        "cavitated_nodes": 100, "groups": {"U": 1e-12},
        "resolution": Resolution(5.0, "resolved", "sufficient", 0.1),
        "moes_film": {"central": 4.0}, "formulas": {"grubin_nm": 10.0}, "work": Work(80.5, 14),
        "wall_s": 2.0, "ranks": 1, "versions": {"mgehl": "0"},
    }  # fmt: skip
    return Result(**(values | changes))


def in_time(**changes):
    """What a `Result` has of a run in time, but for some parts."""
    told = {"end_s": 1.0, "steps": 9, "halved": 0, "largest_closure": 0.0, "largest_node": 0.0}
    return TimeResult(**told | {"convolutions_a_step": 1.0, "passages": 3.0, "means": {}} | changes)


def make_mixed(**changes):
    """A `MixedResult`, but for some parts."""
    told = {"lambda_ratio": 0.25, "Sq_nm": 80.0, "contact_load_share": 0.125, "film_load_share": 0.875}
    told |= {"contact_area_m2": 3e-9, "contact_area_over_hertz": 0.0625, "patches": 7}
    told |= {"largest_patch_m2": 1e-9, "mean_film_nm": 40.0, "minimum_film_nm": None, "torn_share": 0.015}
    told |= {"valley_film_nm": 90.0, "mean_gap_nm": 13.74, "loaded_gap_nm": 2.911}
    told |= {"near_contact_load_share": 0.25, "solid_load_fraction": 0.1, "sealed_load_fraction": 0.0}
    return MixedResult(**told | changes)


def make_solution(kind):
    """A `Solution` of a kind of contact with arbitrary fields."""
    config = config_from_tables(TABLES[kind])
    contact, (ny, nx) = contact_from(config), SHAPES[kind]
    mesh = Mesh(nx, ny, (-1.9, 1.3), (0.0, 0.0) if ny == 1 else (-1.5, 1.5))
    random = np.random.default_rng(7)
    status = (np.arange(nx * ny).reshape(ny, nx) % 4).astype(np.int8)
    fields = Fields(random.random((ny, nx)), random.random((ny, nx)), status)
    result = _wedge_result() if kind == "wedge" else make_result()
    return Solution(config, contact, mesh, fields, [], result, H0=-0.5)


def _wedge_result():
    return Result(
        converged=True, settled=True, reason="the residual holds", load=0.5, load_N=48.0, max_P=0.25,
        min_P=0.0, max_pressure_MPa=0.125, residual=1e-12, flux_imbalance=1e-13, closed_face_flow=0.0,
        solid_nodes=9, cavitated_nodes=0, linear_iterations=12, wall_s=0.5, ranks=1, versions={},
    )  # fmt: skip
