"""How much of a step is taken."""

import numpy as np
import pytest

from mgehl.discretization.status import BOUNDARY, CONTACT, LUBRICATED
from mgehl.solver.settings import NewtonSettings
from mgehl.solver.step_length import step_length


@pytest.mark.parametrize(
    "kind, falls, taken",
    [(LUBRICATED, 10.0, 1.0), (LUBRICATED, -1.0, 0.5), (CONTACT, 10.0, 0.05)],
)
def test_a_film_falls_no_further_than_to_where_it_tears(tiny_problem, kind, falls, taken):
    """Films beside contact that closed were to fall by 7 p_h: each step was cut to a sixteenth."""
    dP = np.zeros(tiny_problem.boundary.shape)
    dP[4, 4] = falls
    status = np.where(tiny_problem.boundary, BOUNDARY, LUBRICATED)
    status[4, 4] = kind
    state = tiny_problem.state(np.full(dP.shape, 0.25), 1.0, status)
    settings = NewtonSettings(max_pressure_step=0.5)
    length, *_ = step_length(tiny_problem, None, None, state, dP, 0.0, settings)
    assert length == taken
