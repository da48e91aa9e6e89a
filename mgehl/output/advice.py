"""What to try after a run that did not converge."""

from mgehl.output import surface
from mgehl.output.resolution import RESOLVED_CELLS

MOST = 3
"""Most pieces of advice that are given."""

AUTO = 'grid.x = "auto" and grid.y = "auto": a domain that holds the contact and its inlet'
OTHER = {
    "film": 'solver.start = "contact": from the other side, where the film is thinner than the grid sees',
    "contact": 'solver.start = "film": from the other side, where the bodies may come apart',
}
"""What else to try, by the start of the run."""


def what_next(solution):
    """Lines with what to try; none after a run that converged."""
    if solution.result.converged:
        return []
    tries = list(_tries(solution))[:MOST]
    return ["what to try next:", *(f"  {each}" for each in tries)]


def _tries(solution):
    """Sentences, the likeliest to help first."""
    result, config = solution.result, solution.config
    if solution.is_dry:
        yield from _of_domain(result.edge)
    if not solution.contact.is_loaded or solution.is_dry:
        yield "solver.max_steps: a higher one, where the residual still falls"
        yield "grid.nodes: another number of nodes"
        return
    yield from _of_domain(result.edge)
    yield from _of_grid(result.resolution, config.grid.nodes)
    if not result.start_note:  # there, the other start was taken already
        yield OTHER[config.solver.start]
    yield "--start-from RUN: from a run at a higher speed that converged; so step by step down to this one"
    yield f"solver.max_steps: more than {config.solver.max_steps}, where the residual still falls"


def _of_domain(edge):
    """A domain that cuts the contact, or a contact of too few nodes."""
    few = "too few nodes" in edge.wrong[0]
    if few:
        yield "more nodes, or a smaller domain: the contact has too few nodes"
    elif edge.wrong[0]:
        yield AUTO


def _of_grid(resolution, nodes):
    """A grid too coarse for the surface or the inlet."""
    if resolution.surface in (surface.COARSE, surface.GRIDS):
        yield f"grid.nodes = {2 * nodes - 1}, or a surface without its short waves"
    if resolution.verdict in ("coarse", "grid-determined"):
        yield (
            f"more nodes or a higher speed: the inlet has {resolution.inlet_cells:.2g} cells and needs "
            f"{RESOLVED_CELLS:g}; mgehl check says how many nodes that takes"
        )
