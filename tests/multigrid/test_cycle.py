import gc
import weakref

import pytest

import mgehl
from mgehl.discretization.scheme import Scheme
from mgehl.multigrid.cycle import CycleSettings, MultigridSolver

SOFT_LINE = {
    "contact.kind": "line", "contact.load_per_length": 18e3, "contact.radius_x": 41.6e-3,
    "contact.reduced_modulus": 0.207e9, "contact.ambient_pressure": 1e5, "lubricant.viscosity": 0.0727,
    "lubricant.pressure_viscosity": 15e-9, "motion.speed": 0.234, "grid.x": "auto", "solver.start": "film",
    "discretization.couette": "3B", "discretization.face_mobility": "linear-gap", "solver.error": False,
}  # fmt: skip


@pytest.mark.parametrize("nodes", [257, 1025])
def test_a_soft_line_takes_two_iterations_a_step_on_every_grid(nodes):
    """On 1025 nodes they were 22, and the solve took 1350 convolutions: the smoother amplified."""
    solution = mgehl.solve(mgehl.load(None, SOFT_LINE | {"grid.nodes": nodes}))
    assert solution.result.converged
    assert max(row["linear_iterations"] for row in solution.rows if row["grid"] == nodes) <= 3


@pytest.mark.parametrize("couette", ["2C", "S2C"])
def test_central_schemes_take_few_iterations(couette):
    """By a cycle of 3B's operators they were up to 23, and 100 on finer grids."""
    film = {"motion.speed": 1.0, "discretization.couette": couette, "grid.nodes": 65, "solver.error": False}
    solution = mgehl.solve(mgehl.load(None, film | {"solver.start": "film"}))
    assert solution.result.converged
    assert max(row["linear_iterations"] for row in solution.rows) <= 12


def test_what_is_freed_leaves_no_jacobian_to_the_garbage_collector(make_hierarchy, paper_contact):
    """A study of rough balls held the arrays of twenty solves that had ended."""
    settings = CycleSettings(rough=True, in_valleys=True)
    contact = paper_contact()
    hierarchy = make_hierarchy(contact, 33, coarsest=17)
    multigrid = MultigridSolver(hierarchy, 1, contact, Scheme(), settings)
    jacobian = weakref.ref(multigrid.jacobian)
    gc.disable()
    try:
        multigrid.free()
        del multigrid
        assert jacobian() is None
    finally:
        gc.enable()
