"""The fluid around a contact start: its first pressure and cavitation set, from coarser grids.

A Newton step or a line sweep moves the boundary of the set by a few nodes, so a fine grid needs many of
them. On 1025 nodes it takes 14 steps from a pressure of zero, and 4 from the coarser grids' pressures.
"""

from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED
from mgehl.solver.on_grid import fluid_on
from mgehl.solver.problem import ContactProblem, State
from mgehl.solver.settings import COARSE_TOLERANCE


def guess_fluid(hierarchy, problem, state, settings):
    """Set the fluid of `state`, in place, to that of the coarser grids in its gap.

    The gap is injected, so no convolution is made; `settings` are a `SolverSettings`. Fluid that is
    beside contact on the coarse grid is left as it is: pressures jump there.
    """
    level = hierarchy.grids.index(problem.grid) - 1
    grid, fewest = hierarchy.grids[level], settings.first_nodes
    if level < 0 or grid.mesh.nx < fewest or not problem.scheme.cavitation:
        return
    transfer, deflection = hierarchy.transfers[level], hierarchy.deflections[level]
    coarse_problem = ContactProblem(grid, deflection, problem.contact, problem.scheme)
    P, H, status, filling = (
        transfer.inject(array) for array in (state.P, state.H, state.status, state.filling)
    )
    coarse = State(P, state.H0, H, status, P.copy(), filling)
    guess_fluid(hierarchy, coarse_problem, coarse, settings)
    with fluid_on(hierarchy, coarse_problem, settings.cycle) as fluid:
        fluid.solve(coarse, COARSE_TOLERANCE, to_rest=False)
    beside_contact, empty = (
        transfer.bilinear((coarse.status == kind).astype(float)) > 0.0 for kind in (CONTACT, CAVITATED)
    )
    film = (state.status == LUBRICATED) & ~beside_contact
    state.P[film] = transfer.bilinear(coarse.P)[film]
    state.p[film] = state.P[film]
    state.status[film & empty & (state.P == problem.contact.tears_at)] = CAVITATED
