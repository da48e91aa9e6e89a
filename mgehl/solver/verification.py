"""What must hold of an answer, checked on the final state without trust in the iteration."""

from dataclasses import dataclass, field

import numpy as np

from mgehl.discretization.axes import own
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
    local = [
        Violation(int(i) + 1, int(j) + grid.first + 1, float(excess[j, i]))
        for j, i in np.argwhere(excess > 0.0)
    ]
    violations = [violation for part in grid.comm.allgather(local) for violation in part]
    beside = np.maximum(neighbour[interface], 0.0)
    ratios = np.divide(
        beside, P[interface], out=np.where(beside > 0.0, np.inf, 0.0), where=P[interface] > 0.0
    )
    return PressureInequality(grid.count(interface), violations, grid.max(ratios, initial=0.0))


def complementarity_error(problem, state, evaluation):
    """Largest breach of the conditions that define the partition, in units of P and H.

    Lubricated: P >= 0 (if the film cavitates) and H >= 0 (where bodies may touch).
    Cavitated: P = 0, H >= 0 and no inflow. Contact: H = 0 and P >= 0. Fluid shut in along the
    motion counts as 1. (H_th is where contact is entered; a node that would be tensile in contact
    may stay film with a gap between 0 and H_th.)
    """
    grid, status, scheme = problem.grid, state.status, problem.scheme
    cavity, contact = status == CAVITATED, status == CONTACT
    tension = contact | (status == LUBRICATED) if scheme.cavitation else contact
    breaches = [
        -state.P[tension],
        np.abs(state.P[cavity]),
        evaluation.inflow[cavity] * grid.mesh.dX,
        np.abs(state.H[contact]),
        enclosed(grid.halo_status(status), problem.axes).astype(float),
    ]
    if scheme.contact_law.has_contact:
        breaches.append(-state.H[is_fluid(status)])
    return max(grid.max(breach, initial=0.0) for breach in breaches)


def flux_imbalance(problem, evaluation):
    """Flow into the film minus flow out of it over all its borders, relative to the inflow.

    The film is all lubricated nodes; its borders are the domain's edge and the cavities. Rounding
    and the residual are all that a conservative scheme may leave.
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
