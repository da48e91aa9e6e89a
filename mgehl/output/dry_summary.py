"""The `Result` of a contact without a film, verified anew as in `summary`."""

from dataclasses import replace

import numpy as np

from mgehl.output.film_error import no_band
from mgehl.output.result import HertzResult, Overlap, Result
from mgehl.output.summary import first_broken, load_off, of_every_load
from mgehl.output.surface import SurfaceOnGrid

PRESSED = 1e-12
"""Pressure of dry contact over the largest, which a peak may have: more than rounding."""


def summarise_dry(problem, outcome, tolerance, making):
    """The `Result` of a contact without a film (collective); gap and load are evaluated anew from P and
    H0."""
    contact = problem.contact
    state = outcome.state = problem.state(outcome.state.P, outcome.state.H0, outcome.state.status)
    nm, hertz = 1e9 * contact.film_scale, contact.hertz
    result = Result(
        **of_every_load(problem, state, making, PRESSED),
        error=no_band("there is no film"),
        complementarity_error=_complementarity_error(problem.grid, state),
        approach_um=-1e-3 * nm * state.H0,
        boundary_nodes=_boundary_nodes(problem, state, tolerance),
        hertz=HertzResult(1e-9 * hertz.p_h, 1e6 * hertz.approach),
        Sq_nm=1e9 * contact.roughness,
        surface=SurfaceOnGrid.of(contact, problem.grid.mesh),
    )
    overlaps = result.overlap.largest_nm > tolerance * nm
    broken = first_broken(_equations(result, outcome, tolerance))
    return replace(
        result, converged=not broken, settled=not broken,
        overlap=result.overlap if overlaps else Overlap(0, 0.0),
        reason=broken or "load, contact and gap hold, and the contact ends within the domain",
    )  # fmt: skip


def _equations(result, outcome, tolerance):
    """What a dry contact must hold."""
    broken, reached = result.complementarity_error, f"at {result.boundary_nodes} nodes: a larger grid.x or"
    yield not outcome.converged, outcome.reason
    yield not abs(result.load_error) <= tolerance, load_off(result.load_error, tolerance)
    yield result.boundary_nodes, f"the contact reaches the domain's boundary {reached} grid.y is needed"
    yield not broken <= tolerance, f"complementarity is broken by {broken:.1e}"
    yield result.edge.too_few, result.edge.too_few


def _complementarity_error(grid, state):
    """Largest breach of P >= 0, H >= 0, one of them zero, over all nodes."""
    pressed = state.P > 0.0
    breaches = -state.P, np.abs(state.H[pressed]), -state.H[~pressed]
    return max(grid.max(breach, initial=0.0) for breach in breaches)


def _boundary_nodes(problem, state, tolerance):
    """Pressed nodes beside the boundary, and boundary nodes where the bodies would overlap."""
    grid = problem.grid
    pressed = (state.P > 0.0) & np.logical_or(*grid.beside_boundary())
    return grid.count(pressed | (problem.boundary & (state.H < -tolerance)))
