"""What drags the plate of a rigid bearing, and where its pressure rests."""

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


class PadDrag(NamedTuple):
    """Of a bearing as wide as it is; of a line of nodes, a mm of it."""

    plate_N: float
    """On the plate, against its motion."""
    centre_mm: float | None
    """X about which the pressure above the ambient one has no moment; None without a load."""


def pad_drag(problem, state):
    """The `PadDrag` of a state (collective). On the plate the oil's shear is eta u/h + (h/2) dp/dx along
    the motion, by as much as a cavity is filled."""
    grid, bearing = problem.grid, problem.contact
    unit = bearing.x_scale * bearing.y_scale * grid.mesh.dX * grid.mesh.dY
    parts = _along(problem) + _before_walls(problem, state)
    dragged = unit * grid.sum((_sliding(problem, state) * _across(problem) * parts).sum())
    dragged += bearing.motion[0] * _by_pressure(problem, state)
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
    walls = ~_open_faces(problem, state)
    beside = np.zeros(state.P.shape)
    beside[:, 1:-1] = walls[:, :-1].astype(float) + walls[:, 1:]
    return 1.5 * beside * (state.status == LUBRICATED)


def _open_faces(problem, state):
    """Which faces along X are open, (lines, nx - 1)."""
    status = problem.grid.halo_status(state.status)
    axis = next(each for each in problem.axes if each.number)
    return open_faces(is_solid(status, problem.scheme.contact_law.closes_faces), axis)


def _across(problem):
    """The same across, (lines, 1): the outermost lines lie on open sides."""
    grid = problem.grid
    lines = np.arange(grid.first, grid.last)[:, None]
    open_side = not (grid.mesh.is_line or problem.contact.closed_sides)
    outermost = (lines == 0) | (lines == grid.mesh.ny - 1)
    return np.where(open_side & outermost, 0.5, 1.0)


def _by_pressure(problem, state):
    """The integral of (h/2) dp/dX in N (collective): of an open face its mean gap times the difference of
    its pressures, which at the edges of a pocket is of first order."""
    grid, bearing = problem.grid, problem.contact
    rise = np.diff(state.P, axis=1) * _open_faces(problem, state)
    between = 0.25 * (state.H[:, 1:] + state.H[:, :-1]) * rise * _across(problem)
    unit = bearing.film_scale * bearing.pressure_scale * bearing.y_scale * grid.mesh.dY
    return unit * grid.sum(between.sum())
