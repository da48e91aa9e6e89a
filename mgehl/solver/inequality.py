"""Eq. 2 of an answer, contact pressure not below the fluid's beside it, checked in two ways: at the
interface, where the paper states it, and between the nodes on both sides."""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.status import CONTACT, is_solid, largest_fluid_neighbour

ROUNDING = 1e-12
"""Difference of pressures in p_h that may come from rounding alone."""

SAFETY = 1.25
"""How many times the estimated errors contact's pressure may be below the fluid's at the interface: an
estimate is now and then too low (of 38570 faces at two), and a rough contact has thousands of faces."""

MOST_UNDECIDED = 0.1
"""Part of the faces from which on the check at the interface decides nothing on this grid."""


@dataclass(frozen=True)
class Power:
    """What the check at the interface could have found, by faces between contact and fluid."""

    faces: int = 0
    undecided: int = 0
    """Faces with a tolerance larger than the contact's own pressure, beside fluid that presses."""
    fluid_pressure: float = 0.0
    """The fluid's largest pressure at these, in p_h: as contact does not pull, no more can be hidden."""

    @property
    def decides(self):
        """Whether nearly all faces are decided."""
        return self.undecided <= MOST_UNDECIDED * self.faces


@dataclass(frozen=True)
class Inequality:
    """Check of [Liu eq. 2]: contact nodes checked, number and size (p_h) of violations."""

    checked: int
    """Contact nodes with fluid on at least one side."""
    violations: int
    worst: float
    """Largest violation, 0 without any."""
    largest_ratio: float
    """Largest fluid pressure over the contact's beside it, of nodes compared; infinite beside P = 0."""
    nodes: list
    """{"i", "j", "size"} of each violation: the contact node, counted from 1, and by how much (p_h)."""
    compared: str = "at the nodes"
    """"at the nodes" beside the interface, "at the interface" between them, or "under contact"."""
    power: Power = Power()
    """How many faces the check at the interface could decide; the others compare without a tolerance."""


def check_pressure_inequality(problem, state):
    """Check P_contact >= P_fluid across the interface, nodes counted from 1  [Liu eqs. 2, 25]."""
    grid, P, status = problem.grid, state.P, state.status
    neighbour = largest_fluid_neighbour(grid.halo(P), grid.halo_status(status), problem.axes)
    interface = (status == CONTACT) & ~(neighbour == -np.inf)
    excess = np.where(interface, neighbour - P, 0.0)
    beside = np.maximum(neighbour[interface], 0.0)
    ratios = np.divide(
        beside, P[interface], out=np.where(beside > 0.0, np.inf, 0.0), where=P[interface] > 0.0
    )
    return _inequality(grid, interface, excess, "at the nodes", grid.max(ratios, initial=0.0))


def _inequality(grid, checked, excess, compared, largest_ratio=0.0, power=Power()):
    """The `Inequality` of `checked` nodes, broken where the `excess` is positive (collective)."""
    local = [
        {"i": int(i) + 1, "j": int(j) + grid.first + 1, "size": float(excess[j, i])}
        for j, i in np.argwhere(excess > 0.0)
    ]
    nodes = [node for part in grid.comm.allgather(local) for node in part]
    worst = max((node["size"] for node in nodes), default=0.0)
    return Inequality(grid.count(checked), len(nodes), worst, largest_ratio, nodes, compared, power)


def check_under_contact(problem, state):
    """Check p <= P at every contact node that has a fluid's pressure of its own  [Liu eq. 2]."""
    grid, contact = problem.grid, state.status == CONTACT
    excess = np.where(contact, state.p - state.P, 0.0)
    return _inequality(grid, contact, np.where(excess > ROUNDING, excess, 0.0), "under contact")


def check_interface(problem, state):
    """Check P(contact) >= P(fluid) at the interface itself, nodes counted from 1  [Liu eqs. 1, 2].

    Both pressures are extrapolated to the face, each with its error (`_at_face`). The gap has one, too:
    half of what it changes across the face changes the pressure on each side by what a node needs for that
    deflection. So a pressure that falls continuously through the interface breaks nothing, a jump does on
    every grid. (Compared at the nodes alone, contact behind a constriction breaks Eq. 2 on all grids.)

    The upper face of contact one node wide may have the fluid's pressure: such a node is broken only where
    fluid presses harder from both sides. Pressure that vanishes as at a dry edge is counted by `Power`.
    """
    grid = problem.grid
    P, H, status = problem.ghosted(state)
    contact, solid = state.status == CONTACT, is_solid(status)
    checked, excess = np.zeros(grid.shape, dtype=bool), np.zeros(grid.shape)
    if not grid.count(contact):
        return _inequality(grid, checked, excess, "at the interface")
    faces, hidden = 0, [np.zeros(0)]
    for axis in problem.axes:
        ends = [contact & ~axis.beside(solid, side) for side in (-1, 1)]
        asked = [_jump(problem, axis, state, (P, H, solid), side) for side in (-1, 1)]
        jumps = [jump for jump, _ in asked]
        is_wide = ~(ends[0] & ends[1])
        for end, jump, other in zip(ends, jumps, reversed(jumps), strict=True):
            jump = np.where(is_wide, jump, np.minimum(jump, other))
            np.maximum(excess, jump, out=excess, where=end & (jump > ROUNDING))
            checked |= end
        faces += sum(map(grid.count, ends))
        hidden += [unseen[end & (unseen > 0.0)] for end, (_, unseen) in zip(ends, asked, strict=True)]
    hidden = np.concatenate(hidden)
    power = Power(faces, grid.count(hidden > 0.0), grid.max(hidden, initial=0.0))
    return _inequality(grid, checked, excess, "at the interface", power=power)


def _jump(problem, axis, state, ghosted, side):
    """By how much the fluid's pressure at the face on a `side` of each node exceeds the node's, all errors
    taken off; and the fluid's where they are larger than the node's own, 0 elsewhere: each (lines, nx).

    `ghosted` are P, H and where it is solid.
    """
    (P, H, solid), axes = ghosted, problem.axes
    of_contact, its_error = _at_face(axes, axis, P, solid, side, sides=(1,))
    of_fluid, error = (
        axis.beside(problem.grid.halo(each), side) for each in _at_face(axes, axis, P, solid, -side)
    )
    of_gap = np.abs(axis.beside(H, side) - state.H) / problem.K00
    tolerance = SAFETY * (error + its_error + of_gap)
    presses = np.maximum(of_fluid, axis.beside(P, side))
    return of_fluid - of_contact - tolerance, np.where(tolerance > state.P, presses, 0.0)


def _at_face(axes, axis, P, solid, side, sides=(1, -1)):
    """Pressure of each node at its face on a `side`, as it comes from behind, and its error: (lines, nx).

    The error is the step to the nearest node behind, the curvature through the two nearest, and how far the
    pressure bends along the face. With no node of its kind behind, half the pressure's change to that side
    (1), or to the one behind (-1), stands for the first two: the larger one of the `sides`.
    """
    near, kind = own(P), own(solid)
    behind, farther = (axis.beside(P, shift * side) for shift in (-1, -2))
    known, known_farther = (axis.beside(solid, shift * side) == kind for shift in (-1, -2))
    step = np.where(known, 0.5 * (near - behind), 0.0)
    bend = np.where(known_farther, 0.375 * np.abs(near - 2.0 * behind + farther), np.abs(step))
    changes = [np.abs(near - axis.beside(P, each * side)) for each in sides]
    unknown = 0.5 * np.maximum.reduce(changes)
    along = sum(bend_of_a_cell(other, P) for other in axes if other is not axis)
    return near + step, np.where(known, np.abs(step) + bend, unknown) + along


def bend_of_a_cell(axis, P):
    """How far the pressure bends from the middle of a cell to its ends, (lines, nx)."""
    return 0.125 * np.abs(axis.beside(P, -1) - 2.0 * own(P) + axis.beside(P, 1))
