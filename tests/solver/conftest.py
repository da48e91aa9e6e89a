import numpy as np
import pytest

from mgehl.discretization.scheme import Scheme
from mgehl.discretization.status import BOUNDARY, LUBRICATED
from mgehl.multigrid.cycle import MultigridSolver
from mgehl.solver.newton import Newton
from mgehl.solver.problem import ContactProblem, State
from mgehl.solver.recipe import recipe_of
from mgehl.solver.settings import NewtonSettings, SolverSettings


@pytest.fixture
def make_newton(make_hierarchy, paper_contact, in_the_end):
    """Factory of (problem, Newton) on 65 nodes, for the film at 1 m/s; freed after the test."""

    def make(monitor=None, kind=Newton, contact=None, scheme=None, **limits):
        contact, scheme = contact or paper_contact(), scheme or Scheme()
        hierarchy = make_hierarchy(contact, 65)
        problem = ContactProblem(hierarchy.grids[-1], hierarchy.deflections[-1], contact, scheme)
        recipe = recipe_of(SolverSettings(scheme=scheme, newton=NewtonSettings(**limits)), contact, "film")
        multigrid = MultigridSolver(hierarchy, 1, contact, scheme, recipe.cycle)
        return problem, in_the_end(kind.free, kind(problem, multigrid, recipe.newton, monitor))

    return make


@pytest.fixture
def state(tiny_problem):
    """All film without pressure and a gap of 1."""
    shape = tiny_problem.grid.shape
    status = np.where(tiny_problem.boundary, BOUNDARY, LUBRICATED).astype(np.int8)
    return State(np.zeros(shape), 0.0, np.ones(shape), status)
