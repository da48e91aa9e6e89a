"""How much of a step is taken."""

import numpy as np
import pytest

from mgehl.discretization.status import BOUNDARY, CONTACT, LUBRICATED
from mgehl.solver.settings import NewtonSettings
from mgehl.solver.step_length import as_oil_flows, step_length


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


def test_in_time_pressures_fall_by_a_step_of_the_reduced_pressure(tiny_problem):
    """q = (1 - e^(-alpha P))/alpha has no other derivative than the one by which the step was linear."""
    shape = tiny_problem.boundary.shape
    status = np.where(tiny_problem.boundary, BOUNDARY, LUBRICATED)
    status[6, 4], P = CONTACT, np.full(shape, 0.25)
    state = tiny_problem.state(P, 1.0, status)
    evaluation = tiny_problem.evaluate(state)
    tiny_problem.K00 = 1e-30  # a gap that answers to no pressure
    dP = np.zeros(shape)
    dP[4, 4], dP[5, 4], dP[6, 4] = 0.4, -0.4, 0.4
    falls = as_oil_flows(tiny_problem, evaluation, state, dP)
    assert falls[5, 4] == -0.4 and falls[6, 4] == 0.4  # a rise, and contact
    fluid = evaluation.fluid
    alpha = -fluid.deps_dP[6, 6] / fluid.eps[6, 6]
    assert alpha * dP[4, 4] > 1.0
    q = (1.0 - np.exp(-alpha * np.array([0.25, 0.25 - falls[4, 4]]))) / alpha
    assert q[0] - q[1] == pytest.approx(np.exp(-alpha * 0.25) * dP[4, 4], rel=1e-12)
