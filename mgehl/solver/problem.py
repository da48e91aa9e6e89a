"""The discrete problem on one grid and its state."""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.axes import axes_of
from mgehl.discretization.evaluation import Evaluation
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.residual import residual
from mgehl.discretization.rows import rows_of
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT
from mgehl.grid.events import ASSEMBLY, event
from mgehl.solver.record import Kept

DIVERGED = 1e10
"""Residual above which a solve counts as diverged; that of a first guess is below 1e4. Values from 1e3 to
1e14 change nothing that converges."""


@dataclass
class State(Kept):
    """A solution on one grid: local lines of pressure, gap and status, and H0."""

    P: np.ndarray
    H0: float
    H: np.ndarray
    status: np.ndarray

    def copy(self):
        return State(self.P.copy(), self.H0, self.H.copy(), self.status.copy())


class Problem:
    """The fluid of a contact on one grid, in a gap that is given: `ContactProblem` has an elastic one."""

    is_elastic = False
    K00 = 0.0
    """Deflection of a node by its own pressure: none in a rigid gap."""

    def __init__(self, grid, contact, scheme):
        self.grid, self.contact, self.scheme = grid, contact, scheme
        self.axes = axes_of(grid.mesh, scheme.motion)
        self.boundary = grid.boundary()

    @event(ASSEMBLY)
    def evaluate(self, state):
        """The `Evaluation` of a state as it is now, its net inflow known  [Liu eq. 35]."""
        ghosted = self.ghosted(state)
        evaluation = Evaluation(*ghosted, self.grid.mesh, self.contact, self.scheme)
        _ = evaluation.inflow
        return evaluation

    @event(ASSEMBLY)
    def change_pressure(self, evaluation, P):
        """Tell an evaluation that the fluid's pressure has changed, and nothing else: `P` has it, ghosts
        too. Its net inflow is known then."""
        evaluation.change_pressure(P)
        _ = evaluation.inflow

    def change_fluid(self, evaluation, state):
        """The same where the fluid's sets have changed, too: the evaluation is told of those of `state`."""
        evaluation.status = self.grid.halo_status(state.status)
        self.change_pressure(evaluation, self.grid.halo(state.P))

    def ghosted(self, state):
        """P, H and status of a state with the neighbours' lines."""
        grid = self.grid
        return grid.halo(state.P), grid.halo(state.H), grid.halo_status(state.status)

    def rows(self, status, frozen=None):
        """The kind of row of every node, (lines, nx); where `frozen` the pressure is held."""
        return rows_of(status, not self.is_elastic, frozen)

    def residual(self, evaluation, status):
        """Rows of the nonlinear residual, (lines, nx), by what the nodes are now."""
        return residual(evaluation, self.rows(status))

    def rms(self, F):
        """Root mean square of a residual over all nodes."""
        return float(np.sqrt(self.grid.sum(np.vdot(F, F)) / self.grid.mesh.nodes))

    def load(self, P):
        """Integral of P  [Liu eq. 50]."""
        mesh = self.grid.mesh
        return mesh.dX * mesh.dY * self.grid.sum(P.sum())


class ContactProblem(Problem):
    """Gap, residual and load balance of a loaded contact on one grid."""

    is_elastic = True

    def __init__(self, grid, deflection, contact, scheme):
        super().__init__(grid, contact, scheme)
        self.deflection = deflection
        self.K00 = influence_coefficients(grid.mesh, contact.kernel, 0, 1)[0, 0]
        self._undeformed = contact.undeformed_gap(grid.X, grid.Y)
        self._load_within = contact.load_within(grid.mesh)

    def gap(self, P, H0):
        """H of [Liu eq. 48] under the pressure P; one convolution."""
        return self.deflection(P) + (self._undeformed + H0)

    def touching(self, P):
        """H0 with which the dry bodies would touch under the first guess P of a pressure."""
        if self.contact.is_hertzian:
            return -self.contact.approach
        gap = self.gap(np.where(self.boundary, 0.0, P), 0.0)
        return -self.grid.min(gap[P > 0.0])

    def state(self, P, H0, status):
        """The state of a given pressure, with its gap; boundary nodes are set."""
        P = np.where(self.boundary, 0.0, P)
        status = np.where(self.boundary, BOUNDARY, status).astype(np.int8)
        return State(P, H0, self.gap(P, H0), status)

    def load_deficit(self, P):
        """Integral of P minus the load that the domain carries  [Liu eq. 50]."""
        return self.load(P) - self._load_within

    def share_of_load(self, P, nodes):
        """Part of the load that some nodes carry, a mask (lines, nx)."""
        return self.load(np.where(nodes, P, 0.0)) / self.contact.load_integral

    def carrying(self, P):
        """The pressure times what makes it carry the domain's load."""
        return P * (self._load_within / self.load(P))

    def mean(self, array, nodes):
        """Mean of an array (lines, nx) over some nodes of all ranks."""
        return self.grid.sum(array[nodes].sum()) / self.grid.count(nodes)

    def films(self, state):
        """Gap at the node nearest to the centre, and the smallest gap, in units of H."""
        i, j = self.grid.mesh.nearest(0.0, 0.0)
        return self.grid.value_at(state.H, i, j), self.grid.min(state.H)

    def counts(self, status):
        """Numbers of contact and of cavitated nodes."""
        return self.grid.count(status == CONTACT), self.grid.count(status == CAVITATED)
