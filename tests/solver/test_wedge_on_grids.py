import numpy as np
import pytest
from contacts import solved

from mgehl.kinds import contact_from
from mgehl.solver.from_config import scheme_from
from mgehl.solver.wedge import solve_wedge

TORN = {
    "contact": {"kind": "wedge"},
    "wedge": {"length": 20e-3, "inlet_film": 10e-6, "exit_film": 20e-6, "width": 10e-3,
              "ambient_pressure": 1e5},
    "lubricant": {"viscosity": 0.01}, "motion": {"speed": 1.0},
    "discretization": {"cavitation": True},
}  # fmt: skip
"""A pad that opens along the motion: a tenth of its nodes are torn."""


@pytest.mark.parametrize("nodes", [129, 257])
def test_where_films_tear_answers_go_up_from_grid_to_grid(make_grid, nodes):
    """Eight steps on any grid; from nothing 19 and 30. The answer is the same."""
    found = solved(TORN, {"grid": {"nodes": nodes}})
    assert found.result.converged and found.result.cavitated_nodes > 0.08 * nodes**2
    assert found.rows[-1]["step"] <= 8
    if nodes == 257:
        return
    config, grid = found.config, make_grid(found.mesh)
    bearing = contact_from(config)
    _, outcome = solve_wedge(grid, bearing, scheme_from(config, bearing), config.solver.tolerance, 60)
    assert outcome.converged and len(outcome.cycles) > 16
    np.testing.assert_array_equal(outcome.state.status, found.fields.status)
    np.testing.assert_allclose(outcome.state.P, found.fields.P, rtol=0.0, atol=1e-9 * found.fields.P.max())
