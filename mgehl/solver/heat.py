"""Temperatures of a solved contact: what its friction heats."""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.status import is_fluid
from mgehl.model.flash import MovingHeat, shared
from mgehl.model.lubricant import USUAL_CONDUCTIVITY


@dataclass(frozen=True)
class Rise:
    """Above the bodies' temperature in K, (lines, nx)."""

    first: np.ndarray
    """Of the surface of body 1."""
    second: np.ndarray
    film: np.ndarray
    """Mean over the thickness of the film."""


def rise_of(problem, state, shear):
    """The `Rise` by a map of `shear` stress in Pa, (lines, nx), of a contact that `has_temperatures`
    (collective). Rank 0 has all of it: ranks do not matter."""
    grid, contact = problem.grid, problem.contact
    heat = shear * contact.friction.sliding_speed(contact.speed)
    gap = problem.scheme.contact_law.flow_gap(state.H)[0]
    gap = contact.film_scale * np.where(is_fluid(state.status), np.maximum(gap, 0.0), 0.0)
    resistance = gap / (contact.lubricant.conductivity or USUAL_CONDUCTIVITY)
    whole = grid.gather(heat), grid.gather(resistance)
    found = (None, None) if whole[0] is None else _rises(contact, grid.mesh, *whole)
    first, second = (grid.scatter(each) for each in found)
    # Heat that is made evenly between two walls: q h/(12 k) above their mean.
    return Rise(first, second, 0.5 * (first + second) + heat * resistance / 12.0)


def _rises(contact, mesh, heat, resistance):
    """Rises of both surfaces, (ny, nx), in the axes of the solve."""
    half = 0.5 * contact.friction.slide_to_roll
    cell = mesh.dX * contact.x_scale, mesh.dY * contact.y_scale
    bodies = (
        MovingHeat(
            solid, [part * contact.speed * (1.0 + slip) for part in contact.motion], heat.shape, *cell
        )
        for solid, slip in zip(contact.solids, (half, -half), strict=True)
    )
    return shared(heat, *bodies, resistance)
