"""What must hold of an answer, checked on the final state without trust in the iteration."""

from dataclasses import dataclass, field

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.mesh import HALO
from mgehl.discretization.status import (
    CAVITATED,
    CONTACT,
    LUBRICATED,
    enclosed,
    is_fluid,
    is_solid,
    largest_fluid_neighbour,
    open_faces,
)

LARGEST_EDGE_PRESSURE = 0.01
"""Largest pressure near the domain's boundary, over the largest of all, of a contact that lies inside the
domain. Measured: configurations of the repository up to 5e-4, domains that are "auto" up to 3e-4 (M from 1
to 200, 65 and 129 nodes, point and line) and where a light contact is ten times as wide as long, 7e-4,
thirty times, 9e-3, starved films on the paper's domain up to 6e-3 (M = 10, 65 nodes); domains that end 1.01
semi-axes from the centre, on one side, 0.02 to 0.9."""

NEAR = 0.1
"""Semi-axes from the boundary at which that pressure is looked at, or a cell, if that is less."""

FEWEST_NODES = 4
"""Fewest nodes of the loaded zone along each axis. Measured: 11 and more on domains that are "auto"."""

ROUNDING = 1e-12
"""Difference of pressures in p_h that may come from rounding alone."""

SAFETY = 1.25
"""How many times the estimated errors contact's pressure may be below the fluid's at the interface.

An estimate is now and then too low, and a rough contact has thousands of faces: of 31000 faces of 19 rough
balls on 257 nodes the difference is more than half of the error at 150, more than .9 of it at six and more
than all of it at two, which the next finer grid does not show."""

LOADED = 0.1
"""Pressure of the loaded zone over the largest: 0.995 semi-axes of a dry contact, more of a light one."""


@dataclass(frozen=True)
class Edge:
    """How a solution stands in its domain and on its grid."""

    pressure: float
    """Largest pressure near the boundary over the largest of all; 0 without pressure."""
    overlapping: int
    """Nodes of the boundary where the gap is negative."""
    largest_overlap: float
    """The largest overlap there, in units of H."""
    across: tuple
    """Nodes along X and along Y that the loaded zone is wide; of a line contact None along Y."""


def check_edge(problem, state, part=LOADED):
    """How the contact stands in its domain: what lies beyond was not solved (collective).

    The loaded zone has at least this `part` of the largest pressure.
    """
    grid, P = problem.grid, state.P
    largest, overlap = grid.max(P), np.where(problem.boundary, -state.H, 0.0)
    near = _pressure_near_boundary(grid, P)
    loaded = largest * part <= P
    columns = np.logical_or.reduce(grid.comm.allgather(loaded.any(axis=0)))
    across = None if grid.mesh.is_line else grid.count(loaded.any(axis=1))
    return Edge(
        pressure=near / largest if largest > 0.0 else 0.0,
        overlapping=grid.count(overlap > 0.0),
        largest_overlap=grid.max(overlap, initial=0.0),
        across=(int(np.count_nonzero(columns)), across),
    )


def _pressure_near_boundary(grid, P):
    """Largest pressure `NEAR` the boundary: from a node it falls in proportion to the distance."""
    beside, cells = grid.beside_boundary(), (grid.mesh.dX, grid.mesh.dY)
    found = [
        grid.max(P[nodes], initial=0.0) * min(NEAR / cell, 1.0)
        for nodes, cell in zip(beside, cells, strict=True)
    ]
    return max(found)


@dataclass(frozen=True)
class Violation:
    """A contact node whose pressure is below the fluid pressure beside it; sizes in p_h."""

    i: int
    j: int
    size: float


@dataclass(frozen=True)
class PressureInequality:
    """Result of checking [Liu eq. 2] on all four sides of every contact node."""

    checked: int
    """Contact nodes with fluid on at least one side."""
    violations: list = field(default_factory=list)
    largest_ratio: float = 0.0
    """Largest fluid pressure over the contact pressure beside it; infinite beside P = 0."""

    @property
    def worst(self):
        """Largest violation in units of p_h, 0 without any."""
        return max((violation.size for violation in self.violations), default=0.0)


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
    return _inequality(grid, interface, excess, grid.max(ratios, initial=0.0))


def _inequality(grid, checked, excess, largest_ratio=0.0):
    """The `PressureInequality` of `checked` nodes, broken where the `excess` is positive (collective)."""
    local = [
        Violation(int(i) + 1, int(j) + grid.first + 1, float(excess[j, i]))
        for j, i in np.argwhere(excess > 0.0)
    ]
    violations = [violation for part in grid.comm.allgather(local) for violation in part]
    return PressureInequality(grid.count(checked), violations, largest_ratio)


def check_interface(problem, state):
    """Check P(contact) >= P(fluid) at the interface itself, nodes counted from 1  [Liu eqs. 1, 2].

    The paper compares the two sides of the interface, which lies between two nodes. Both pressures are
    extrapolated to the face, each from nodes of its side, and each has an error (`_at_face`). The gap has
    one, too: half of what it changes across the face, where a wake may begin, changes the pressure on each
    side by as much as a node needs for that deflection. So a pressure that rises or falls continuously
    through the interface does not break Eq. 2. A jump that stays as the grid is refined is found on every
    grid. (Compared at the nodes alone, contact behind a constriction, where the pressure falls, breaks the
    inequality on all grids alike.)

    Measured on a ball with roughness of 100 nm rms, a boundary film of 2 nm, 0.5 mm/s: beside the interface
    pressures of 257 and 513 nodes differ by 0.010 p_h (median), in one of ten nodes by more than 0.020.

    Contact one node wide through which the pressure falls has no second node that could tell the pressure
    at its upper face: it may be that of the fluid there, and breaks nothing on this axis. Such a node is
    broken only where the fluid presses harder from both sides.
    """
    grid = problem.grid
    P, H, status = problem.ghosted(state)
    contact, solid = state.status == CONTACT, is_solid(status)
    checked, excess = np.zeros(grid.shape, dtype=bool), np.zeros(grid.shape)
    if not grid.count(contact):
        return _inequality(grid, checked, excess)
    for axis in problem.axes:
        ends = [contact & ~_beside(axis, solid, side) for side in (-1, 1)]
        jumps = [_jump(problem, axis, state, (P, H, solid), side) for side in (-1, 1)]
        is_wide = ~(ends[0] & ends[1])
        for end, jump, other in zip(ends, jumps, reversed(jumps), strict=True):
            jump = np.where(is_wide, jump, np.minimum(jump, other))
            np.maximum(excess, jump, out=excess, where=end & (jump > ROUNDING))
            checked |= end
    return _inequality(grid, checked, excess)


def _jump(problem, axis, state, ghosted, side):
    """By how much the fluid's pressure at the face on a `side` of each node exceeds the node's, all errors
    taken off: (lines, nx). `ghosted` are P, H and where it is solid."""
    (P, H, solid), axes = ghosted, problem.axes
    of_contact, its_error = _at_face(axes, axis, P, solid, side, sides=(1,))
    of_fluid, error = (
        _beside(axis, problem.grid.halo(each), side) for each in _at_face(axes, axis, P, solid, -side)
    )
    of_gap = np.abs(_beside(axis, H, side) - state.H) / problem.K00
    return of_fluid - of_contact - SAFETY * (error + its_error + of_gap)


def _beside(axis, ghosted, shift):
    """What a ghosted array holds `shift` nodes along an axis, (lines, nx); lines end as they are."""
    lines, nx = own(ghosted).shape
    if axis.number:
        return own(ghosted)[:, np.clip(np.arange(nx) + shift, 0, nx - 1)]
    return ghosted[HALO + shift : HALO + shift + lines]


def _at_face(axes, axis, P, solid, side, sides=(1, -1)):
    """Pressure of each node at its face on a `side`, as it comes from behind, and its error: (lines, nx).

    The error has three parts: the step to the nearest node behind, the curvature through the two nearest,
    and how far the pressure bends along the face. Where no node of its kind is behind it, half the
    pressure's change to that side (1), or to the one behind (-1), stands for the first two: the larger one
    of the `sides`.
    """
    near, kind = own(P), own(solid)
    behind, farther = (_beside(axis, P, shift * side) for shift in (-1, -2))
    known, known_farther = (_beside(axis, solid, shift * side) == kind for shift in (-1, -2))
    step = np.where(known, 0.5 * (near - behind), 0.0)
    bend = np.where(known_farther, 0.375 * np.abs(near - 2.0 * behind + farther), np.abs(step))
    changes = [np.abs(near - _beside(axis, P, each * side)) for each in sides]
    unknown = 0.5 * np.maximum.reduce(changes)
    along = sum(_bend_of_a_cell(other, P) for other in axes if other is not axis)
    return near + step, np.where(known, np.abs(step) + bend, unknown) + along


def _bend_of_a_cell(axis, P):
    """How far the pressure bends from the middle of a cell to its ends, (lines, nx)."""
    return 0.125 * np.abs(_beside(axis, P, -1) - 2.0 * own(P) + _beside(axis, P, 1))


def complementarity_error(problem, state, evaluation):
    """Largest breach of the conditions that define the partition, in units of P and H.

    Lubricated: P >= 0 (if the film cavitates) and H >= 0 (where bodies may touch). Cavitated: P = 0, H >= 0
    and no inflow. Contact: P >= 0 and H = 0, or the boundary film and no inflow. Fluid shut in along the
    motion counts as 1. A film node whose gap falls below H_th becomes contact. A node that contact has
    released stays film until the bodies would overlap, so its gap may lie between 0 and H_th.
    """
    grid, status, scheme = problem.grid, state.status, problem.scheme
    law = scheme.contact_law
    cavity, contact = status == CAVITATED, status == CONTACT
    tension = contact | (status == LUBRICATED) if scheme.cavitation else contact
    breaches = [
        -state.P[tension],
        np.abs(state.P[cavity]),
        evaluation.inflow[cavity] * grid.mesh.dX,
        np.abs(state.H[contact] - law.contact_gap),
    ]
    if law.closes_faces:
        breaches.append(enclosed(grid.halo_status(status), problem.axes).astype(float))
    else:
        breaches.append(evaluation.inflow[contact] * grid.mesh.dX)
    if law.has_contact:
        breaches.append(-state.H[is_fluid(status)])
    return max(grid.max(breach, initial=0.0) for breach in breaches)


def flux_imbalance(problem, evaluation):
    """Flow into the film minus flow out of it over all its borders, relative to the inflow.

    The film is all lubricated nodes; its borders are the domain's edge and the cavities. A conservative
    scheme leaves nothing but rounding and the residual.
    """
    grid, mesh = problem.grid, problem.grid.mesh
    film, into = evaluation.status == LUBRICATED, []
    for axis, (leaving, entering) in zip(evaluation.axes, evaluation.flows, strict=True):
        width = mesh.dX * mesh.dY / axis.cell
        here = axis.inner(own(film))
        # A face between ranks is counted by the rank whose node is film.
        first, last = here & ~axis.neighbour(film, -1), here & ~axis.neighbour(film, 1)
        into += [width * axis.entered(entering.value)[first], -width * axis.left(leaving.value)[last]]
    flow = np.concatenate(into)
    total = grid.sum(flow.sum())
    inflow = grid.sum(flow[flow > 0.0].sum())
    return abs(total) / inflow if inflow > 0.0 else 0.0


def closed_face_flow(problem, evaluation):
    """Largest flow through a face that contact closes: what leaks through solid  [Liu eq. 4]."""
    leaks = []
    for axis, both in zip(evaluation.axes, evaluation.flows, strict=True):
        shut = ~open_faces(is_solid(evaluation.status), axis)
        leaks += [flow.value[shut] for flow in both]
    return max(problem.grid.max(np.abs(leak), initial=0.0) for leak in leaks)
