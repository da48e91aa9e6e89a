"""What must hold of an answer, checked on the final state without trust in the iteration."""

from dataclasses import dataclass, field

import numpy as np

from mgehl.discretization.faces import x_flows, y_flows
from mgehl.discretization.fluid import fluid_state
from mgehl.discretization.status import (
    CAVITATED,
    CONTACT,
    LUBRICATED,
    close_gaps,
    largest_fluid_neighbour,
    open_x_faces,
    open_y_faces,
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


def check_pressure_inequality(grid, P, status):
    """Check P_contact >= P_fluid across the interface, nodes counted from 1  [Liu eqs. 2, 25]."""
    neighbour = largest_fluid_neighbour(grid.halo(P), grid.halo_status(status))
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


def complementarity_error(problem, state):
    """Largest breach of the conditions that define the partition, in units of P and H.

    Lubricated: P >= 0 (if the film cavitates) and H >= 0 (not asked of the unified equations).
    Cavitated: P = 0, H >= 0 and no inflow. Contact: H = 0 and P >= 0. Fluid shut in from west and
    east counts as 1. (H_th is where contact is entered; a node that would be tensile in contact
    may stay film with a gap between 0 and H_th.)
    """
    grid, status = problem.grid, state.status
    film, cavity, contact = status == LUBRICATED, status == CAVITATED, status == CONTACT
    open_gap = film | cavity if problem.scheme.gap_floor is None else cavity & ~cavity
    tension = film | contact if problem.scheme.cavitation else contact
    breaches = (
        -state.P[tension],
        np.abs(state.P[cavity]),
        problem.inflow(state)[cavity] * grid.mesh.dX,
        np.abs(state.H[contact]),
        -state.H[open_gap],
        np.array([float(close_gaps(status.copy()))]),
    )
    return max(grid.max(breach, initial=0.0) for breach in breaches)


def flux_imbalance(problem, state):
    """Flow into the film minus flow out of it over all its borders, relative to the inflow.

    The film is all lubricated nodes; its borders are the domain's edge and the cavities. Rounding
    and the residual are all that a conservative scheme may leave.
    """
    grid, mesh, scheme = problem.grid, problem.grid.mesh, problem.scheme
    P, H, status = grid.halo(state.P), grid.halo(state.H), grid.halo_status(state.status)
    fluid = fluid_state(P, H, problem.contact, problem.scheme.gap_floor)
    leaving, entering = x_flows(fluid[1:-1], state.status, mesh, scheme)
    across = y_flows(fluid, status, mesh, scheme).value * mesh.dX
    film = status == LUBRICATED
    inner = film[1:-1]
    first, last = inner[:, 1:] & ~inner[:, :-1], inner[:, :-1] & ~inner[:, 1:]
    into = [entering.value[first] * mesh.dY, -leaving.value[last] * mesh.dY]
    # A face between ranks is counted by the rank whose node is film.
    into.append(across[:-1][inner & ~film[:-2]])
    into.append(-across[1:][inner & ~film[2:]])
    flows = np.concatenate(into)
    total = grid.sum(flows.sum())
    inflow = grid.sum(flows[flows > 0.0].sum())
    return abs(total) / inflow if inflow > 0.0 else 0.0


def closed_face_flow(problem, state):
    """Largest flow through a face that contact closes: what leaks through solid  [Liu eq. 4]."""
    grid, mesh, scheme = problem.grid, problem.grid.mesh, problem.scheme
    P, H, status = grid.halo(state.P), grid.halo(state.H), grid.halo_status(state.status)
    fluid = fluid_state(P, H, problem.contact, scheme.gap_floor)
    shut = ~open_x_faces(state.status)
    leaks = [flow.value[shut] for flow in x_flows(fluid[1:-1], state.status, mesh, scheme)]
    leaks.append(y_flows(fluid, status, mesh, scheme).value[~open_y_faces(status)])
    return max(grid.max(np.abs(leak), initial=0.0) for leak in leaks)
