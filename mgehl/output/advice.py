"""What to try after a run that did not converge."""

from dataclasses import replace

from mgehl.config_value import AUTO as AUTOMATIC
from mgehl.kinds import settled
from mgehl.output import surface
from mgehl.output.resolution import RESOLVED_CELLS

MOST = 3
"""Most pieces of advice that are given."""

AUTO = 'grid.x = "auto" and grid.y = "auto": a domain that holds the contact and its inlet'
LARGER = 1.5
"""Times the domain that is advised where "auto" is not enough: roughness makes a contact wider."""
JUST = 1e-6
"""Semi-axes that do not matter."""
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
        yield from _of_domain(solution)
    if not solution.contact.is_loaded or solution.is_dry:
        yield "solver.max_steps: a higher one, where the residual still falls"
        yield "grid.nodes: another number of nodes"
        return
    yield from _of_domain(solution)
    yield from _of_grid(result.resolution, config.grid.nodes)
    if not result.start_note:  # there, the other start was taken already
        yield OTHER[config.solver.start]
    yield "--start-from RUN: from a run at a higher speed that converged; so step by step down to this one"
    yield f"solver.max_steps: more than {config.solver.max_steps}, where the residual still falls"


def _of_domain(solution):
    """A domain that cuts the contact, or a contact of too few nodes."""
    edge = solution.result.edge
    if edge.cuts:
        yield _larger(solution) if _has_autos_room(solution) else AUTO
    elif edge.too_few:
        yield "more nodes, or a smaller domain: the contact has too few nodes"


def _has_autos_room(solution):
    """Whether the domain is as large as the one that "auto" chooses."""
    config = solution.config
    open_grid = replace(config.grid, x=AUTOMATIC, y=AUTOMATIC)
    auto = settled(replace(config, grid=open_grid), solution.contact).grid
    pairs = ((config.grid.x, auto.x), *([] if solution.contact.is_plane else [(config.grid.y, auto.y)]))
    return all(ends[0] <= room[0] + JUST and ends[1] >= room[1] - JUST for ends, room in pairs)


def _larger(solution):
    """A larger domain, in numbers."""
    grid = solution.config.grid
    names = "x" if solution.contact.is_plane else "xy"
    ends = [[round(LARGER * end, 2) for end in getattr(grid, name)] for name in names]
    said = " and ".join(f"grid.{name} = {each}" for name, each in zip(names, ends, strict=True))
    return f"{said}: the contact is wider than that of smooth bodies"


def _of_grid(resolution, nodes):
    """A grid too coarse for the surface or the inlet."""
    if resolution.surface in (surface.COARSE, surface.GRIDS):
        yield f"grid.nodes = {2 * nodes - 1}, or a surface without its short waves"
    if resolution.verdict in ("coarse", "grid-determined"):
        yield (
            f"more nodes or a higher speed: the inlet has {resolution.inlet_cells:.2g} cells and needs "
            f"{RESOLVED_CELLS:g}; mgehl check says how many nodes that takes"
        )
