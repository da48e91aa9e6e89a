"""A run of a rigid bearing: nothing is kept on the way, for it takes seconds."""

import time
from contextlib import contextmanager
from dataclasses import replace
from functools import partial

from mgehl.errors import ConfigError
from mgehl.grid.grid import single_grid
from mgehl.kinds import checked_case
from mgehl.output import progress
from mgehl.output.surroundings import versions
from mgehl.output.users_axes import solution_of
from mgehl.output.wedge_summary import load_band, summarise_wedge
from mgehl.solver.from_config import set_up
from mgehl.solver.journal import Asked
from mgehl.solver.wedge import Found, solve_wedge


def solve_bearing(case, parts, comm, watch):
    """The `Solution` of the `Case` of a rigid bearing, `parts` its `SetUp` (collective)."""
    started = time.perf_counter()
    coarser, why_no_more = _coarser(case)
    loads, found = _on_coarser(coarser, comm, watch)
    with _solved_bearing(parts, comm, watch, found) as (problem, outcome):
        result = summarise_wedge(problem, outcome, versions())
        rows = progress.wedge_rows(parts.mesh.nx, outcome.cycles)
        for row in rows:
            watch.speaker.row(row)
        band = load_band(result, loads, why_no_more)
        result = replace(result, **band, wall_s=time.perf_counter() - started)
        return solution_of(case, parts, problem, outcome.state, rows, result)


def _coarser(case):
    """(Nodes, `SetUp`) of the same bearing on ever fewer nodes, and why there are no fewer: two grids for a
    band. Where films tear all of them: answers go up from grid to grid."""
    found, nodes = [], case.config.grid.nodes
    while case.config.discretization.cavitation or len(found) < 2:
        nodes = (nodes - 1) // 2 + 1
        try:
            found.append((nodes, set_up(checked_case(case.config.with_({"grid.nodes": nodes})))))
        except ConfigError as error:
            return found, str(error)
    return found, ""


def _on_coarser(coarser, comm, watch):
    """(Nodes, load in N, None without an answer) of the coarser grids, finest first, and what was `Found`
    on the finest of them where films tear."""
    loads, found = [], None
    for nodes, parts in reversed(coarser):
        with _solved_bearing(parts, comm, watch, found) as (problem, outcome):
            result = summarise_wedge(problem, outcome, {})
            loads.insert(0, (nodes, result.load_N if result.converged else None))
            begins = result.converged and parts.settings.scheme.cavitation
            found = Found.of(problem, outcome.state) if begins else None
    return loads, found


@contextmanager
def _solved_bearing(parts, comm, watch, found):
    """Problem and `Outcome` of a bearing, begun from what was `Found`, while its grid is there."""
    grid, limits = single_grid(parts.mesh, comm), parts.settings.newton
    try:
        stop = partial(Asked(watch.stop).step, grid, None)
        how = limits.tolerance, limits.max_steps, stop, found
        yield solve_wedge(grid, parts.contact, parts.settings.scheme, *how)
    finally:
        grid.destroy()
