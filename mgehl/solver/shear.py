"""Shear on the bodies of a solved contact: of the film, of solids, and what rolling takes."""

from dataclasses import dataclass, replace

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.status import CAVITATED, CONTACT, is_fluid, is_solid, open_faces
from mgehl.model.conditions import Conditions
from mgehl.model.drag import wake_shear

TINY = 1e-300
"""No pressure at all: nothing is carried."""


@dataclass(frozen=True)
class Shear:
    """Shear stresses by sliding, (lines, nx) in Pa, and forces in N, of a line contact in N/m."""

    film: np.ndarray
    """Of film, of cavities as far as they are filled, and of layers by the part of P that oil carries."""
    solids: np.ndarray
    """Of contact, by the rest."""
    film_force: float
    solid_force: float
    rolling: tuple
    """On body 1 and on body 2, against the motion."""

    @property
    def stress(self):
        """Of film and solids."""
        return self.film + self.solids

    @property
    def sliding_force(self):
        """By that stress."""
        return self.film_force + self.solid_force

    @property
    def rolling_force(self):
        """By rolling, mean of both bodies."""
        return 0.5 * sum(self.rolling)


def shear_of(problem, state):
    """The `Shear` of a state (collective)."""
    film, solids = film_shear(problem, state), solid_shear(problem, state)
    cell = problem.contact.cell_area(problem.grid.mesh)
    forces = (cell * problem.grid.sum(each.sum()) for each in (film, solids))
    return Shear(film, solids, *forces, rolling_of_bodies(problem, state))


def outlets(problem):
    """Where the motion leaves the domain along X and Y: at the last nodes, -1, or at the first ones, 0."""
    return [-1 if problem.sense * part >= 0.0 else 0 for part in problem.contact.motion]


def as_the_motion_goes(problem):
    """The mesh, its ends turned so that the motion leaves at the last nodes."""
    mesh = problem.grid.mesh
    ends = zip((mesh.x, mesh.y), outlets(problem), strict=True)
    x, y = (pair if outlet else (-pair[1], -pair[0]) for pair, outlet in ends)
    return replace(mesh, x=x, y=y)


BESIDE = {-1: -2, 0: 1}
"""The last nodes that are solved before an outlet."""


def flows_out_whole(problem, state):
    """Whether the film leaves the domain without a cavity, as under an ambient pressure (collective).

    Without such a pressure every film tears behind the contact. A wave that passes the last nodes may
    shut the cavity there, but not for long.
    """
    if problem.scheme.cavitation and problem.contact.tears_at >= 0.0:
        return False
    grid, (column, line) = problem.grid, (BESIDE[outlet] for outlet in outlets(problem))
    torn = state.status == CAVITATED
    lines = np.arange(grid.first, grid.last) == line % grid.mesh.ny
    return not grid.count(torn[:, column]) + (0 if grid.mesh.is_line else grid.count(torn[lines]))


def shear_of_wake(problem, state):
    """Shear of the oil that leaves the domain where the film is torn, in N, of a line contact in N/m
    (collective): it takes from bodies that slide as long as it lies between them."""
    grid, contact, law = problem.grid, problem.contact, problem.scheme.contact_law
    mesh, (end_x, end_y) = as_the_motion_goes(problem), outlets(problem)
    x, y = contact.x_scale * mesh.X[:: 1 if end_x else -1], contact.y_scale * mesh.Y[:: 1 if end_y else -1]
    content = contact.film_scale * state.full_part * law.flow_gap(state.H)[0]
    behind = content[:, BESIDE[end_x]]
    if mesh.is_line:
        return float(wake_shear(contact, x[[end_x]], None, behind)[0])
    lines, (motion_x, motion_y) = np.arange(grid.first, grid.last), np.abs(contact.motion)
    inside = (lines > 0) & (lines < mesh.ny - 1)
    sheared = wake_shear(contact, np.full(inside.sum(), x[end_x]), y[lines[inside]], behind[inside])
    total = motion_x * contact.y_scale * mesh.dY * sheared.sum()
    for beside in content[lines == BESIDE[end_y] % mesh.ny, 1:-1]:
        sheared = wake_shear(contact, x[1:-1], np.full(mesh.nx - 2, y[end_y]), beside)
        total += motion_y * contact.x_scale * mesh.dX * sheared.sum()
    return grid.sum(total)


def coefficient(problem, state):
    """Shear of film and solids over the load; None where the surfaces do not slide (collective)."""
    if problem.contact.friction.slide_to_roll == 0.0:
        return None
    return shear_of(problem, state).sliding_force / problem.contact.load


def friction_difference(problem, one, other):
    """Sum of the sizes by which the shear of two states differs at nodes, over the load (collective)."""
    grid, contact = problem.grid, problem.contact
    if contact.friction.slide_to_roll == 0.0:
        return 0.0
    apart = sum(shear(problem, one) - shear(problem, other) for shear in (film_shear, solid_shear))
    return contact.cell_area(grid.mesh) * grid.sum(np.abs(apart).sum()) / contact.load


def film_shear(problem, state):
    """Shear stress of the oil in Pa, (lines, nx): nothing where there is no gap."""
    contact, law = problem.contact, problem.scheme.contact_law
    speed = contact.friction.sliding_speed(contact.speed)
    tau, gap = np.zeros(state.P.shape), law.flow_gap(state.H)[0]
    part = _part_of_oil(state, law, contact.tears_at)
    here = (part > 0.0) & (gap > 0.0)
    if speed == 0.0 or not here.any():
        return tau
    p_h, oil = contact.pressure_scale, contact.lubricant
    P = np.maximum(state.p[here], contact.tears_at)
    thicker = np.broadcast_to(oil.log_viscosity(P[None], p_h)[0], (1, P.size))[0]
    eta = oil.cold_viscosity * np.exp(thicker)
    # The part of a node that is sheared as oil carries its own part of the load: P presses it.
    pressed = oil.ambient_pressure + p_h * np.maximum(state.P[here], contact.tears_at)
    at = Conditions(pressed, eta, shear_rate=speed / (contact.film_scale * gap[here]))
    tau[here] = contact.friction.rheology.shear_stress(at)
    return part * tau


def _part_of_oil(state, law, tears_at):
    """How much of each node is sheared as oil, 0 to 1, (lines, nx): of contact that lets fluid through what
    the fluid carries, so that friction does not jump as contact opens."""
    torn, contact = state.status == CAVITATED, state.status == CONTACT
    part = np.where(torn, state.filling, is_fluid(state.status).astype(float))
    if not law.closes_faces:
        by_oil, by_both = (each[contact] - tears_at for each in (state.p, state.P))
        part[contact] = np.clip(by_oil / np.maximum(by_both, TINY), 0.0, 1.0)
    return part


def solid_shear(problem, state):
    """Shear stress of solids in Pa, (lines, nx). They carry P - p where contact lets fluid through, and P
    where it closes its faces, or bodies overlap."""
    contact, law = problem.contact, problem.scheme.contact_law
    if contact.friction.slide_to_roll == 0.0:
        return np.zeros(state.P.shape)
    carried = state.P if law.closes_faces else state.P - state.p
    touching = (state.status == CONTACT) | is_fluid(state.status) & (law.flow_gap(state.H)[0] <= 0.0)
    coefficient = contact.friction.boundary_coefficient
    return np.where(touching, coefficient * contact.pressure_scale * carried, 0.0)


def rolling_of_bodies(problem, state):
    """What rolling drags body 1 and body 2 by, in N, of a line contact in N/m (collective): the oil's
    shear, and P on the slopes of its heights s. Of both that is -int P x/R, as between smooth bodies,
    whatever s is: half of int h dp/dx alone falls by half of int s dP/dx. Heights that stand still between
    bodies that both move are neither's."""
    film, surface = rolling_force(problem, state), problem.surfaced.surface
    of_bodies, slip = [film, film], problem.contact.friction.slide_to_roll
    if surface is None:
        return tuple(of_bodies)
    for body, moved in surface.moving:
        of_bodies[body - 1] += _on_slopes(problem, state, moved)
    if abs(slip) == 2.0:
        moving = sum(of_bodies) - 2.0 * film
        of_bodies[1 if slip > 0.0 else 0] += _on_slopes(problem, state, surface) - moving
    return tuple(of_bodies)


def _on_slopes(problem, state, surface):
    """What P on the slopes of a `Surface` drags its body by (collective)."""
    grid, contact = problem.grid, problem.contact
    heights = surface.height(grid.X * contact.x_scale, grid.Y * contact.y_scale) / contact.film_scale
    heights = grid.halo(np.ascontiguousarray(np.broadcast_to(heights, grid.shape)))
    return _driven(problem, heights, grid.halo(state.P))


def rolling_force(problem, state):
    """Half of the integral of h dp/dx along the motion, in N, of a line contact in N/m (collective): so
    much the oil's shear drags each body. Of a full film between smooth bodies it is exactly the load times
    how far its centre lies upstream, over 2 R."""
    grid, law = problem.grid, problem.scheme.contact_law
    p, H, status = grid.halo(state.p), grid.halo(state.H), grid.halo_status(state.status)
    return 0.5 * _driven(problem, law.flow_gap(H)[0], p, is_solid(status, law.closes_faces))


def _driven(problem, gap, P, solid=None):
    """Integral of a `gap` times dP/dx along the motion, in N, of a line contact in N/m (collective): of a
    face its mean gap times its pressure difference. Ghosted; faces of what is `solid` are shut."""
    grid, contact, total = problem.grid, problem.contact, 0.0
    for axis, part, scale in zip(
        problem.axes, contact.motion, (1.0 / contact.x_scale, 1.0 / contact.y_scale), strict=False
    ):
        mean = 0.5 * (axis.at(gap, 0) + axis.at(gap, 1))
        drag = mean * (axis.at(P, 1) - axis.at(P, 0))
        if solid is not None:
            drag = np.where(open_faces(solid, axis), drag, 0.0)
        # Along Y a face belongs to the line behind it: no two ranks count it.
        total += part * scale / axis.cell * float((drag if axis.number else drag[: len(own(P))]).sum())
    unit = contact.cell_area(grid.mesh) * contact.film_scale * contact.pressure_scale
    return problem.sense * unit * grid.sum(total)
