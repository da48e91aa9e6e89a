"""What drags the plate of a rigid bearing, and where its pressure rests."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from mgehl.discretization.status import (
    BOUNDARY,
    CAVITATED,
    CONTACT,
    LUBRICATED,
    is_fluid,
    is_solid,
    open_faces,
)
from mgehl.solver.shear import rolling_force


class PadDrag(NamedTuple):
    """Forces and where they act."""

    plate_N: float
    """On the plate, against its motion."""
    centre_mm: float | None
    """X about which the pressure above the ambient one has no moment; None without a load."""


def pad_drag(problem, state):
    """The `PadDrag` of a state (collective). Oil drags the plate by eta u/h, in a cavity by as much as that
    is filled, and by (h/2) dp/dx along the motion, which at a pocket's edges is of first order."""
    grid, bearing = problem.grid, problem.contact
    parts = _across(problem) * (_along(problem) + _before_walls(problem, state))
    dragged = bearing.cell_area(grid.mesh) * grid.sum((_sliding(problem, state) * parts).sum())
    dragged += rolling_force(problem, replace(state, p=None))
    above = np.where(state.status == CONTACT, 0.0, state.P - bearing.ambient)
    load, moment = (grid.sum(each.sum()) for each in (above, above * grid.X))
    return PadDrag(dragged, moment / load if load else None)


def _sliding(problem, state):
    """eta u/h in Pa, (lines, nx); nothing where there is no gap, or no oil."""
    bearing, oil = problem.contact, problem.contact.lubricant
    fluid = (is_fluid(state.status) | (state.status == BOUNDARY)) & (state.H > 0.0)
    filled = np.where(state.status == CAVITATED, state.filling, fluid)
    thicker = oil.log_viscosity(np.maximum(state.P, bearing.tears_at), bearing.pressure_scale)[0]
    eta = oil.cold_viscosity * np.exp(thicker)
    return filled * eta * bearing.speed / (bearing.film_scale * np.where(fluid, state.H, 1.0))


def _along(problem):
    """The part of each cell along X, (nx,), that lies under the pad: the mesh begins half a cell outside of
    the exit, and ends at the inlet."""
    part = np.ones(problem.grid.mesh.nx)
    inlet, exit = (0, -1) if problem.contact.turned else (-1, 0)
    part[inlet], part[exit] = 0.5, 0.0
    return part


def _before_walls(problem, state):
    """What the pressure drags in half cells of film beside faces along X that are closed, over the sliding,
    (lines, nx): nothing flows there, so (h/2) dp/dx is 3 eta u/h."""
    status = problem.grid.halo_status(state.status)
    axis = next(each for each in problem.axes if each.number)
    walls = ~open_faces(is_solid(status, problem.scheme.contact_law.closes_faces), axis)
    beside = np.zeros(state.P.shape)
    beside[:, 1:-1] = walls[:, :-1].astype(float) + walls[:, 1:]
    return 1.5 * beside * (state.status == LUBRICATED)


def _across(problem):
    """The same across, (lines, 1): the outermost lines lie on open sides."""
    grid = problem.grid
    lines = np.arange(grid.first, grid.last)[:, None]
    open_side = not (grid.mesh.is_line or problem.contact.closed_sides)
    outermost = (lines == 0) | (lines == grid.mesh.ny - 1)
    return np.where(open_side & outermost, 0.5, 1.0)
