"""The `Result` of a rigid bearing, its final state evaluated."""

from dataclasses import replace

import numpy as np

from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, WALL
from mgehl.output.film_error import no_band
from mgehl.output.result import Result
from mgehl.solver.mass import account, beside_open_sides
from mgehl.solver.pad_drag import pad_drag
from mgehl.solver.verification import closed_face_flow, flux_imbalance

ROUNDING = 1e-12
"""Part of what the plate carries below which a flow is rounding."""

BY_CELLS = 1.5
"""Times the difference to the next coarser grid that an error of first order may be, where a pillar's edge
lies anywhere within a cell: of a square one 0.2, 1.4 and 0.5 on 129, 257 and 513 nodes."""


def summarise_wedge(problem, outcome, versions):
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
    wide = 1.0 if grid.mesh.is_line else grid.mesh.y[1] - grid.mesh.y[0]
    mass, carries = account(problem, state, evaluation, pad, unit), unit * wide * grid.max(state.H)
    if not (grid.mesh.is_line or bearing.closed_sides):
        beside = beside_open_sides(problem, evaluation, unit)
        mass = replace(mass, enters=mass.enters + beside, leaves=mass.leaves + beside)
    drag = pad_drag(problem, state)
    flows = max(mass.enters, mass.leaves) > ROUNDING * carries  # nothing does behind walls all around
    return Result(
        converged=outcome.converged,
        settled=outcome.converged,
        reason=outcome.reason,
        load=load,
        load_N=load * bearing.pressure_scale * bearing.x_scale * bearing.y_scale,
        drag_N=drag.plate_N,
        drag_power_W=drag.plate_N * bearing.speed,
        pressure_centre_mm=drag.centre_mm,
        max_P=largest,
        min_P=grid.min(state.P),
        max_pressure_MPa=1e-6 * bearing.pressure_scale * largest,
        residual=problem.rms(problem.residual(evaluation, state.status)),
        flux_imbalance=flux_imbalance(problem, evaluation) if flows else 0.0,
        closed_face_flow=closed_face_flow(problem, evaluation),
        solid_nodes=grid.count(solid),
        cavitated_nodes=cavities,
        linear_iterations=sum(step.linear_iterations for step in outcome.cycles),
        wall_s=0.0,
        ranks=grid.comm.size,
        versions=versions,
        error=no_band("the gap of a rigid bearing is given"),
        torn_filling=grid.sum(state.filling[torn].sum()) / cavities if cavities else None,
        mass=replace(mass, carried_in=max(mass.carried_in, carries)),
    )


def load_band(result, coarser, why_no_more=""):
    """The parts of a bearing's `Result` that say how well its load is known, by (nodes, load in N, None for
    no answer) of the coarser grids, finest first, and why there are no more. The load is of first order
    where a pillar ends at nodes, and what ends there jumps by cells; a pocket's edges lie between nodes.

    A single difference may be small by chance: half of that between the coarser grids counts, too.
    """
    if not result.converged:
        return {"load_band_how": "the run has not converged"}
    if not coarser:
        too_coarse = why_no_more.startswith("grid.nodes")
        return {
            "load_band_how": "there is no coarser grid" + (f": {why_no_more}" if not too_coarse else "")
        }
    (nodes, load), *more = coarser
    if load is None:
        return {"load_band_how": f"on {nodes} nodes, the next coarser grid, there is no answer"}
    difference, how = abs(result.load_N - load), f"from the difference to {nodes} nodes"
    if more and more[0][1] is not None:
        after_next, coarsest = more[0]
        difference = max(difference, 0.5 * abs(load - coarsest))
        how = f"from the differences to {nodes} and {after_next} nodes"
    return {"load_band_N": BY_CELLS * difference, "load_band_how": how}
