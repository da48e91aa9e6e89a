"""A contact on one grid, from a state: the problem's solver is made here, used, and freed."""

from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial

from mgehl.multigrid.cycle import MultigridSolver
from mgehl.solver.newton import Newton
from mgehl.solver.recipe import A_STATE, recipe_of


@dataclass(frozen=True)
class LevelSolve:
    """What is being solved: the grid's nodes along X and the speed in m/s."""

    nodes: int
    speed: float | None
    """None where there is no fluid."""
    finest: bool
    news: str = ""
    """What its user should know of the way here; empty where all goes as planned."""


def solve_near(task, problem, state, news="", **limits):
    """Solve a `ContactProblem` on its grid from a `state` near its own; return the `Outcome`.

    By the settings of a `Task`, whatever contact and scheme that has. The `state` is the solve's own from
    now on. `limits` overrule those that the recipe has of Newton's method; `news` as of a `LevelSolve`.
    """
    contact, grid, hierarchy = problem.contact, problem.grid, task.hierarchy
    recipe = recipe_of(replace(task.settings, scheme=problem.scheme), contact, A_STATE)
    recipe = replace(recipe, newton=replace(recipe.newton, **limits))
    solve = LevelSolve(grid.mesh.nx, contact.speed, grid is hierarchy.grids[-1], news)
    return solve_on(task, problem, state, recipe, solve)


def solve_on(task, problem, state, recipe, solve):
    """The same as a `Recipe` says, told of as this `LevelSolve`."""
    with newton_on(task.hierarchy, problem, recipe, partial(task.monitor, solve)) as newton:
        return newton.run(state, task.journal)


@contextmanager
def newton_on(hierarchy, problem, recipe, tell=None):
    """A `Newton` for a problem, with its linear solver (collective)."""
    level = hierarchy.grids.index(problem.grid)
    multigrid = MultigridSolver(hierarchy, level, problem.contact, problem.scheme, recipe.cycle)
    newton = Newton(problem, multigrid, recipe.newton, tell)
    try:
        yield newton
    finally:
        newton.free()
