"""Solutions made by hand for the tests of files: few nodes, no two of them alike."""

import numpy as np
from test_files import make_result

from mgehl.config import config_from_tables
from mgehl.discretization.mesh import Mesh
from mgehl.kinds import contact_from
from mgehl.output.result import Result
from mgehl.output.solution import Fields, Solution

TABLES = {
    "point": {"contact": {"radius_y": 25.4e-3}, "motion": {"speed": 0.5}},
    "line": {"contact": {"kind": "line"}, "motion": {"speed": 0.5}},
    "wedge": {"contact": {"kind": "wedge"}},
}
SHAPES = {"point": (5, 7), "line": (1, 7), "wedge": (5, 7)}


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
