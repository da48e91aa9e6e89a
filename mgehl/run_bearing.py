"""A run of a rigid bearing: nothing is kept on the way, for it takes seconds."""

import time
from contextlib import contextmanager
from dataclasses import replace
from functools import partial

from mgehl.grid.grid import single_grid
from mgehl.kinds import checked_case
from mgehl.output import progress
from mgehl.output.surroundings import versions
from mgehl.output.users_axes import solution_of
from mgehl.output.wedge_summary import load_band, summarise_wedge
from mgehl.solver.from_config import set_up
from mgehl.solver.journal import Asked
from mgehl.solver.wedge import solve_wedge


def solve_bearing(case, parts, comm, watch):
    """The `Solution` of the `Case` of a rigid bearing, `parts` its `SetUp` (collective)."""
    started = time.perf_counter()
    with _solved_bearing(parts, comm, watch) as (problem, outcome):
        result = summarise_wedge(problem, outcome, 0.0, versions())
        rows = progress.wedge_rows(parts.mesh.nx, outcome.cycles)
        for row in rows:
            watch.speaker.row(row)
        band = load_band(result, partial(_load_on_coarser, case, comm, watch))
        result = replace(result, **band, wall_s=time.perf_counter() - started)
        return solution_of(case, parts, problem, outcome.state, rows, result)


@contextmanager
def _solved_bearing(parts, comm, watch):
    """Problem and `Outcome` of a bearing, while its grid is there."""
    grid, limits = single_grid(parts.mesh, comm), parts.settings.newton
    try:
        stop = partial(Asked(watch.stop).step, grid, None)
        yield solve_wedge(
            grid, parts.contact, parts.settings.scheme, limits.tolerance, limits.max_steps, stop
        )
    finally:
        grid.destroy()


def _load_on_coarser(case, comm, watch, by):
    """(Nodes, load in N) of the same bearing `by` so many times coarser; the load is None where it has none
    there. Raises ConfigError where the grid is too coarse for it."""
    nodes = (case.config.grid.nodes - 1) // by + 1
    coarser = set_up(checked_case(case.config.with_({"grid.nodes": nodes})))
    with _solved_bearing(coarser, comm, watch) as (problem, outcome):
        result = summarise_wedge(problem, outcome, 0.0, {})
        return nodes, result.load_N if result.converged else None
