"""The fluid around a contact start, guessed from the coarser grids."""

import numpy as np
import pytest

from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.solver.fluid_guess import guess_fluid
from mgehl.solver.nested import first_guess
from mgehl.solver.problem import ContactProblem
from mgehl.solver.rigid_gap import RigidGapFluid
from mgehl.solver.settings import SolverSettings


@pytest.fixture
def start(paper_contact, make_hierarchy):
    """Hierarchy, problem and first guess of full contact at 0.005 mm/s on 257 nodes."""
    hierarchy = make_hierarchy(paper_contact(5e-6), 257)
    settings = SolverSettings()
    problem = ContactProblem(
        hierarchy.grids[-1], hierarchy.deflections[-1], paper_contact(5e-6), settings.scheme
    )
    return hierarchy, problem, first_guess(problem, "contact"), settings


def steps_of_first_solve(start, make_multigrid, state):
    hierarchy, problem, _, _ = start
    fluid = RigidGapFluid(problem, make_multigrid(hierarchy, problem, state, rigid=True), "test_fluid_")
    try:
        return len(fluid.solve(state, 1e-10).steps) - 1
    finally:
        fluid.free()


def test_the_fluid_is_found_in_few_steps_and_is_the_same(start, make_multigrid):
    hierarchy, problem, plain, settings = start
    guessed, before = plain.copy(), hierarchy.convolutions
    guess_fluid(hierarchy, len(hierarchy.grids) - 1, problem, guessed, settings)
    assert hierarchy.convolutions == before
    assert steps_of_first_solve(start, make_multigrid, plain) >= 5
    assert steps_of_first_solve(start, make_multigrid, guessed) <= 4
    # But for nodes beside contact, that are not solved apart and that Newton's next step fills.
    other = guessed.status != plain.status
    assert other.sum() <= 4 and (problem.evaluate_full(guessed).inflow[other] > 0.0).all()
    np.testing.assert_allclose(guessed.P, plain.P, rtol=0.0, atol=2e-6)


def test_contact_and_its_gap_are_left_alone(start):
    hierarchy, problem, plain, settings = start
    guessed = plain.copy()
    guess_fluid(hierarchy, len(hierarchy.grids) - 1, problem, guessed, settings)
    contact = plain.status == CONTACT
    np.testing.assert_array_equal(guessed.status == CONTACT, contact)
    np.testing.assert_array_equal(guessed.P[contact], plain.P[contact])
    np.testing.assert_array_equal(guessed.H, plain.H)
    assert guessed.P.min() >= 0.0
    assert (guessed.P[guessed.status == CAVITATED] == 0.0).all()
    assert (guessed.P[(guessed.status == LUBRICATED)] > 0.0).sum() > 1000


def test_the_coarsest_grid_has_none_to_ask(start):
    hierarchy, problem, plain, settings = start
    guessed = plain.copy()
    guess_fluid(hierarchy, 0, problem, guessed, settings)
    np.testing.assert_array_equal(guessed.P, plain.P)
    np.testing.assert_array_equal(guessed.status, plain.status)
