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

    @property
    def worst(self):
        """Largest violation in units of p_h, 0 without any."""
        return max((violation.size for violation in self.violations), default=0.0)


def check_pressure_inequality(grid, P, status):
    """Check P_contact >= P_fluid across the interface, nodes counted from 1  [Liu eq. 2]."""
    neighbour = largest_fluid_neighbour(grid.halo(P), grid.halo(status))
    interface = (status == CONTACT) & ~(neighbour == -np.inf)
    excess = np.where(interface, neighbour - P, 0.0)
    local = [
        Violation(int(i) + 1, int(j) + grid.first + 1, float(excess[j, i]))
        for j, i in np.argwhere(excess > 0.0)
    ]
    violations = [violation for part in grid.comm.allgather(local) for violation in part]
    return PressureInequality(grid.count(interface), violations)


def complementarity_error(problem, state):
    """Largest breach of the conditions that define the partition, in units of P and H.

    Lubricated: P >= 0 and H >= 0. Cavitated: P = 0, H >= 0 and no inflow. Contact: H = 0 and
    P >= 0. Fluid shut in from west and east counts as 1. (H_th is where contact is entered; a
    node that would be tensile in contact may stay film with a gap between 0 and H_th.)
    """
    grid, status = problem.grid, state.status
    film, cavity, contact = status == LUBRICATED, status == CAVITATED, status == CONTACT
    breaches = (
        -state.P[film | contact],
        np.abs(state.P[cavity]),
        problem.inflow(state)[cavity] * grid.mesh.dX,
        np.abs(state.H[contact]),
        -state.H[film | cavity],
        np.array([float(close_gaps(status.copy()))]),
    )
    return max(grid.max(breach, initial=0.0) for breach in breaches)


def flux_imbalance(problem, state):
    """Flow into the film minus flow out of it over all its borders, relative to the inflow.

    The film is all lubricated nodes; its borders are the domain's edge and the cavities. Rounding
    and the residual are all that a conservative scheme may leave.
    """
    grid, mesh, scheme = problem.grid, problem.grid.mesh, problem.scheme
    P, H, status = (grid.halo(array) for array in (state.P, state.H, state.status))
    fluid = fluid_state(P, H, problem.contact)
    leaving, entering = x_flows(fluid[1:-1], state.status, mesh, scheme.couette, scheme.face_mobility)
    across = y_flows(fluid, status, mesh, scheme.face_mobility).value * mesh.dX
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
