"""A contact on one grid, from a state: the problem's solver is made here, used, and freed."""

from contextlib import contextmanager

from mgehl.multigrid.cycle import MultigridSolver
from mgehl.solver.newton import Newton
from mgehl.solver.rigid_gap import RigidGapFluid


def solve_on(hierarchy, level, problem, state, recipe, tell, journal):
    """Solve a `ContactProblem` on grid `level` from a `state`, as its `Recipe` says; return the `Outcome`.

    `tell(cycle)` is called with every `Cycle`.
    """
    with newton_on(hierarchy, level, problem, recipe, tell) as newton:
        return newton.run(state, journal)


@contextmanager
def newton_on(hierarchy, level, problem, recipe, tell=None):
    """A `Newton` for a problem on grid `level`, with its linear solvers (collective)."""
    prefix, fluid = recipe.cycle.options_prefix, None
    how = hierarchy, level, problem.contact, problem.scheme, recipe.cycle
    try:
        if recipe.fluid_apart:
            fluid = RigidGapFluid(problem, MultigridSolver(*how, rigid=True), prefix + "fluid_")
        multigrid = MultigridSolver(*how, apart=recipe.fluid_apart)
        newton = Newton(problem, multigrid, recipe.newton, fluid, prefix, tell)
        try:
            yield newton
        finally:
            newton.free()
    finally:
        if fluid:
            fluid.free()
