"""The `Result` of a dry contact, which has no film."""

import numpy as np

from mgehl.output.edge_result import edge_result
from mgehl.output.film_error import no_band
from mgehl.output.result import HertzResult, Overlap, Result, contact_result, overlap_of

PRESSED = 1e-12
"""Pressure of contact over the largest, which a peak may have: more than rounding."""

NO_FILM = no_band("there is no film")


def summarise_dry(problem, outcome, tolerance, work, wall_s, versions):
    """Verify the final state and put the `Result` together (collective).

    Gap and load are evaluated anew from P and H0; nothing that the iteration said is trusted.
    """
    grid, contact = problem.grid, problem.contact
    state = outcome.state = problem.state(outcome.state.P, outcome.state.H0, outcome.state.status)
    nm = 1e9 * contact.film_scale
    solid = contact_result(problem, state, nm)
    overlap = _overlap(grid, state, nm, tolerance)
    load_error = problem.load_deficit(state.P)
    complementarity = _complementarity_error(grid, state)
    at_boundary = _boundary_nodes(problem, state, tolerance)
    edge = edge_result(problem, state, nm, PRESSED)
    found = load_error, complementarity, at_boundary, edge.too_few
    converged, reason = _verdict(outcome, tolerance, *found)
    hertz = contact.hertz
    return Result(
        converged=converged,
        settled=converged,
        reason=reason,
        max_pressure_GPa=1e-9 * hertz.p_h * grid.max(state.P),
        approach_um=-1e-3 * nm * state.H0,
        load_error=load_error,
        complementarity_error=complementarity,
        contact=solid,
        overlap=overlap,
        boundary_nodes=at_boundary,
        hertz=HertzResult(1e-9 * hertz.p_h, 1e6 * hertz.approach),
        Sq_nm=1e9 * contact.roughness,
        work=work,
        wall_s=wall_s,
        ranks=grid.comm.size,
        versions=versions,
        error=NO_FILM,
        edge=edge,
    )


def _complementarity_error(grid, state):
    """Largest breach of P >= 0, H >= 0, one of them zero, over all nodes."""
    pressed = state.P > 0.0
    breaches = -state.P, np.abs(state.H[pressed]), -state.H[~pressed]
    return max(grid.max(breach, initial=0.0) for breach in breaches)


def _overlap(grid, state, nm, tolerance):
    """Where bodies overlap by more than the tolerance, in units of H."""
    found = overlap_of(grid, state, nm)
    return found if found.largest_nm > tolerance * nm else Overlap(0, 0.0)


def _boundary_nodes(problem, state, tolerance):
    """Pressed nodes beside the boundary, and boundary nodes where the bodies would overlap."""
    grid = problem.grid
    pressed = (state.P > 0.0) & np.logical_or(*grid.beside_boundary())
    return grid.count(pressed | (problem.boundary & (state.H < -tolerance)))


def _verdict(outcome, tolerance, load_error, complementarity, at_boundary, too_few):
    """Whether all holds, and what does not."""
    if not outcome.converged:
        return False, outcome.reason
    if not abs(load_error) <= tolerance:
        return False, f"the load is off by {load_error:.1e}, more than {tolerance:.1e}"
    if at_boundary:
        return False, (
            f"the contact reaches the domain's boundary at {at_boundary} nodes: a larger grid.x or grid.y"
            " is needed"
        )
    if not complementarity <= tolerance:
        return False, f"complementarity is broken by {complementarity:.1e}"
    if too_few:
        return False, too_few
    return True, "load, contact and gap hold, and the contact ends within the domain"
