"""Newton's method for the fluid around the contact at 0.005 mm/s, its gap held fixed."""

import numpy as np
import pytest

from mgehl.discretization.axes import own
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.solver.rigid_gap import RigidGapFluid


@pytest.fixture
def dry(solve, paper_contact):
    return solve(paper_contact(5e-6), 65, start="contact")


@pytest.fixture
def fluid(dry, make_multigrid):
    made = []
    multigrid = make_multigrid(dry.hierarchy, dry.problem, dry.outcome.state, rigid=True)
    made.append(RigidGapFluid(dry.problem, multigrid, "test_fluid_"))
    yield made[0]
    made[0].free()


def test_it_balances_the_fluid_without_convolutions(dry, fluid):
    problem, solved = dry.problem, dry.outcome.state
    state = solved.copy()
    film = state.status == LUBRICATED
    state.P[film] *= 0.5
    separable = fluid.separable(dry.problem.evaluate(state), state.status)
    assert (separable & film).any()
    before = dry.hierarchy.convolutions
    settled = fluid.solve(state, 1e-9)
    assert dry.hierarchy.convolutions == before
    inflow = problem.evaluate(state).inflow
    np.testing.assert_array_equal(settled.evaluation.inflow, inflow)
    np.testing.assert_array_equal(own(settled.evaluation.status), state.status)
    assert settled.steps[-1].residual <= 1e-9 < settled.steps[0].residual
    kept = np.where(separable & (state.status == LUBRICATED), inflow, 0.0)
    assert problem.rms(kept) <= 1e-9
    assert state.P.min() >= 0.0
    cavity = separable & (state.status == CAVITATED)
    assert inflow[cavity].max(initial=0.0) <= 1e-9 / problem.grid.mesh.dX
    np.testing.assert_array_equal(state.status == CONTACT, solved.status == CONTACT)
    np.testing.assert_array_equal(state.H, solved.H)
    np.testing.assert_array_equal(state.status == BOUNDARY, problem.boundary)


def test_it_finds_the_solved_fluid_again(dry, fluid):
    solved = dry.outcome.state
    state = solved.copy()
    separable = fluid.separable(dry.problem.evaluate(state), state.status)
    film = separable & (state.status == LUBRICATED)
    state.P[film] *= 0.5
    fluid.solve(state, 1e-12)
    largest = solved.P[film].max()
    np.testing.assert_allclose(state.P[film], solved.P[film], rtol=0.0, atol=1e-3 * largest)
    np.testing.assert_array_equal(state.P[~film], solved.P[~film])
