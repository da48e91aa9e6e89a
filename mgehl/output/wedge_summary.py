"""The `Result` of a rigid bearing, its final state evaluated."""

from contextlib import suppress

import numpy as np

from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, WALL
from mgehl.errors import ConfigError
from mgehl.output.film_error import no_band
from mgehl.output.result import Result
from mgehl.solver.mass import account
from mgehl.solver.verification import closed_face_flow, flux_imbalance

BY_CELLS = 1.5
"""Times the difference to the next coarser grid that an error of first order may be, where a pillar's edge
lies anywhere within a cell: of a square one 0.2, 1.4 and 0.5 on 129, 257 and 513 nodes."""


def summarise_wedge(problem, outcome, wall_s, versions):
    """The `Result` of a rigid bearing, its final state evaluated (collective)."""
    grid, bearing, state = problem.grid, problem.contact, outcome.state
    evaluation = problem.evaluate(state)
    across = bearing.width / bearing.y_scale if grid.mesh.is_line else 1.0
    solid, torn = state.status == CONTACT, state.status == CAVITATED
    load = across * problem.load(np.where(solid, state.P, state.P - bearing.ambient))
    largest, cavities = grid.max(state.P), grid.count(torn)
    pad = (evaluation.status != BOUNDARY) & (evaluation.status != WALL)
    # Half of what the plate would carry along is dragged through a gap.
    unit = 0.5 * bearing.speed * bearing.film_scale * bearing.y_scale * across
    return Result(
        converged=outcome.converged,
        settled=outcome.converged,
        reason=outcome.reason,
        load=load,
        load_N=load * bearing.pressure_scale * bearing.x_scale * bearing.y_scale,
        max_P=largest,
        min_P=grid.min(state.P),
        max_pressure_MPa=1e-6 * bearing.pressure_scale * largest,
        residual=problem.rms(problem.residual(evaluation, state.status)),
        flux_imbalance=flux_imbalance(problem, evaluation),
        closed_face_flow=closed_face_flow(problem, evaluation),
        solid_nodes=grid.count(solid),
        cavitated_nodes=cavities,
        linear_iterations=sum(step.linear_iterations for step in outcome.cycles),
        wall_s=wall_s,
        ranks=grid.comm.size,
        versions=versions,
        error=no_band("the gap of a rigid bearing is given"),
        torn_filling=grid.sum(state.filling[torn].sum()) / cavities if cavities else None,
        mass=account(problem, state, evaluation, pad, unit),
    )


def load_band(result, solve_coarser):
    """The parts of a bearing's `Result` that say how well its load is known. The load is of first order
    where a pillar ends at nodes, and what ends there jumps by cells; a pocket's edges lie between nodes.
    `solve_coarser(n)` gives (nodes, load in N) of every n-th node.

    A single difference may be small by chance: half of that between the coarser grids counts, too.
    """
    if not result.converged:
        return {"load_band_how": "the run has not converged"}
    try:
        nodes, load = solve_coarser(2)
    except ConfigError as error:
        return {"load_band_how": f"the next coarser grid is too coarse: {error}"}
    if load is None:
        return {"load_band_how": f"on {nodes} nodes, the next coarser grid, there is no answer"}
    difference, how = abs(result.load_N - load), f"from the difference to {nodes} nodes"
    with suppress(ConfigError):
        after_next, coarsest = solve_coarser(4)
        if coarsest is not None:
            difference = max(difference, 0.5 * abs(load - coarsest))
            how = f"from the differences to {nodes} and {after_next} nodes"
    return {"load_band_N": BY_CELLS * difference, "load_band_how": how}
