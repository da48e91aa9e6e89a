"""The film that there would be if shear did not thin it: the same contact once more, from the answer."""

from dataclasses import replace
from functools import partial

from mgehl.solver.nested import LevelSolve
from mgehl.solver.on_grid import solve_on
from mgehl.solver.problem import ContactProblem
from mgehl.solver.recipe import A_STATE, recipe_of


def unthinned(hierarchy, problem, state, settings, monitor, journal):
    """The `ContactProblem` whose oil shear does not thin, and its `Outcome`, from a `state` of the thinned
    one (collective); `monitor` and `journal` as of `nested_iteration`."""
    contact = problem.contact
    contact = replace(contact, friction=replace(contact.friction, thins=False))
    level, grid = len(hierarchy.grids) - 1, problem.grid
    thicker = ContactProblem(grid, hierarchy.deflections[level], contact, problem.scheme)
    begun = thicker.state(state.P, state.H0, state.status.copy(), state.p.copy(), state.filling.copy())
    tell = partial(monitor, LevelSolve(grid.mesh.nx, contact.speed, True))
    recipe = recipe_of(settings, contact, A_STATE)
    return thicker, solve_on(hierarchy, level, thicker, begun, recipe, tell, journal)
