"""What to know beside the numbers of a run, and what to try after one that did not converge."""

from dataclasses import replace

from mgehl.config_value import AUTO
from mgehl.kinds import with_domain
from mgehl.kinds.heat import heat_words
from mgehl.kinds.loaded import lambda_words
from mgehl.output import surface
from mgehl.output.resolution import RESOLVED_CELLS
from mgehl.solver.beginning import NOR
from mgehl.solver.recipe import FULL_FILM, IN_CONTACT, OF_ROUGH, OTHER_SIDE, TOUCHING
from mgehl.solver.recipe_words import NAMES

MOST = 4
"""Most pieces of advice that are given."""

LARGER = 1.5
"""Times the domain that is advised where "auto" is not enough: roughness makes a contact wider."""

JUST = 1e-6
"""Semi-axes that do not matter."""

SHORTER = 10.0
"""Rate of time steps (`solver.squeeze`) by which peaks that touch are found that 3 does not lead to. As the
default it would take a fifth more work, and loses others."""

FIRST_ORDER = "1B"
"""Scheme of the Couette flow that has states where 3L has none: of unseen seeds five rollers on 1025 nodes
(59 to 964 convolutions), of `study mixed` four balls (to 3305). Its films are thicker, of fifteen balls
by 2 to 100 %."""

OTHER = {
    FULL_FILM: 'solver.start = "contact": from the other side, where the film is thinner than a grid sees',
    IN_CONTACT: 'solver.start = "film": from the other side, where the bodies may come apart',
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
    if solution.contact.is_loaded:
        yield from _of_domain(solution)
    if solution.contact.is_loaded and (result.edge.cuts or (result.settled and result.edge.wrong[0])):
        return
    if not solution.contact.is_loaded or solution.is_dry:
        yield "solver.max_steps: a higher one, where the residual still falls"
        yield "grid.nodes: another number of nodes"
        return
    solver, default = config.solver, type(config.solver)()
    more = f"more than {solver.max_steps}, {solver.max_work}, where the residual still falls"
    more = f"solver.max_steps, solver.max_work: {more}"
    is_short = solver.max_steps < default.max_steps or solver.max_work < default.max_work
    if is_short:
        yield more
    nodes, resolution = config.grid.nodes, result.resolution
    if (result.recipe or {}).get("couette") == OF_ROUGH:
        yield f'discretization.couette = "{FIRST_ORDER}": a first-order scheme, for a first answer'
    if resolution.surface in (surface.COARSE, surface.GRIDS):
        yield f"grid.nodes = {2 * nodes - 1}, or a surface without its short waves"
    if resolution.verdict in ("coarse", "grid-determined"):
        yield (
            f"more nodes or a higher speed: the inlet has {resolution.inlet_cells:.2g} cells and needs "
            f"{RESOLVED_CELLS:g}; mgehl check says how many nodes that takes"
        )
    if (result.recipe or {}).get("peaks") == TOUCHING and config.solver.squeeze < SHORTER:
        yield f"solver.squeeze = {SHORTER:g}: shorter time steps, for a fifth more work"
    if OTHER_SIDE[config.solver.start] not in (result.recipe or {}).get("otherwise", []):
        yield OTHER[config.solver.start]
    if NOR not in result.reason:
        yield "--start-from RUN: from a run at a higher speed that converged; so step by step down"
    if not is_short:
        yield more


def _of_domain(solution):
    """A domain that cuts the contact: that of "auto", or a larger one where that has no more room."""
    edge, config = solution.result.edge, solution.config
    if not edge.cuts:
        if edge.too_few:
            yield "more nodes, or a smaller domain: the contact has too few nodes"
        return
    names = "x" if solution.contact.is_line else "xy"
    open_grid = replace(config.grid, **dict.fromkeys(names, AUTO))
    auto = with_domain(replace(config, grid=open_grid), solution.contact).grid
    ends = {name: getattr(config.grid, name) for name in names}
    if any(low > getattr(auto, name)[0] + JUST or high < getattr(auto, name)[1] - JUST
           for name, (low, high) in ends.items()):  # fmt: skip
        keys = " and ".join(f'grid.{name} = "auto"' for name in names)
        yield f"{keys}: a domain that holds the contact and its inlet"
    else:
        larger = {name: [round(LARGER * end, 2) for end in pair] for name, pair in ends.items()}
        keys = " and ".join(f"grid.{name} = {pair}" for name, pair in larger.items())
        yield f"{keys}: the contact is wider than that of smooth bodies"


def beside_bands(solution):
    """Lines about what the bands of a film do not hold: the start it was found from where that is not the
    one that was asked for, lambda by a number, heat in the inlet."""
    config, contact = solution.config, solution.contact
    if not contact.is_loaded or solution.is_dry or not solution.result.converged:
        return
    start, begins = config.solver.start, (solution.result.recipe or {}).get("begins")
    if begins == OTHER_SIDE[start]:
        yield f"start: from {NAMES[start]} there was no answer; this one is from {NAMES[begins]}"
    film = 1e-9 * solution.result.central_film_nm
    yield from (f"lambda: {words}" for words in lambda_words(config, film, "the computed"))
    yield from heat_words(config, contact)
