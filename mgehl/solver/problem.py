"""The discrete problem on one grid and its state."""

from copy import copy
from dataclasses import dataclass, replace
from math import nan

import numpy as np

from mgehl.discretization.axes import axes_of
from mgehl.discretization.contents import OVERFULL, feeding, missing_fillings, passed_on
from mgehl.discretization.evaluation import Evaluation
from mgehl.discretization.influence import influence_coefficients
from mgehl.discretization.residual import linearise, residual, shifted
from mgehl.discretization.rows import rows_of
from mgehl.discretization.status import BOUNDARY, CAVITATED, CONTACT, LUBRICATED
from mgehl.grid.events import ASSEMBLY, event
from mgehl.solver.films import weights_of_centre
from mgehl.solver.record import Kept

AT_REST = (0.0, 0.0)
"""The `motion` of a scheme without a Couette flow."""

DIVERGED = 1e10
"""Residual above which a solve counts as diverged; that of a first guess is below 1e4."""


@dataclass
class State(Kept):
    """A solution on one grid: local lines of pressure, gap and status, and H0."""

    P: np.ndarray
    """What the bodies feel: the pressure of the fluid and of the solids together."""
    H0: float
    H: np.ndarray
    status: np.ndarray
    p: np.ndarray | None = None
    """The fluid's own pressure: P but for contact, where solids carry the rest. None: P everywhere."""
    filling: np.ndarray | None = None
    """The part of the gap above the layers that cavities hold fluid in, of other nodes whatever they had as
    cavities; None: all of it."""

    def __post_init__(self):
        self.p = self.P.copy() if self.p is None else self.p
        self.filling = np.ones(np.shape(self.P)) if self.filling is None else self.filling

    @property
    def full_part(self):
        """The part of the gap above the layers that holds fluid: 1 but in cavities."""
        return np.where(self.status == CAVITATED, self.filling, 1.0)

    def copy(self):
        arrays = (self.H, self.status, self.p, self.filling)
        return State(self.P.copy(), self.H0, *(array.copy() for array in arrays))


class Problem:
    """The fluid of a contact on one grid, in a gap that is given: `ContactProblem` has an elastic one."""

    sense = 1.0
    """1 of surfaces that move in the contact's direction, -1 against it."""
    storage = None
    """The `Storage` of the time step that is taken; None of what is steady."""
    K00 = 0.0
    """Deflection of a node by its own pressure: none in a rigid gap."""
    gaps = None
    """The `FaceGap` along each axis of a gap that is given between nodes, too."""
    heights = None
    """Heights of the bodies at the local nodes in m; None of smooth ones."""

    def __init__(self, grid, contact, scheme):
        self.grid, self.contact, self.scheme = grid, contact, scheme
        self.flowing = contact
        """The contact with its oil as it is now: what flows is evaluated by it."""
        self.surfaced = contact
        """The contact with its surfaces as they are now, under the load of the beginning."""
        self.axes = axes_of(grid.mesh, scheme.motion)
        self.boundary = grid.boundary()

    @event(ASSEMBLY)
    def evaluate(self, state):
        """The `Evaluation` of a state as it is now, its net inflow known  [Liu eq. 35]."""
        grid = self.grid
        p, status = grid.halo(state.p), grid.halo_status(state.status)
        H = grid.halo(state.H) if self.gaps is None else np.ones(grid.ghosted_shape)
        filling = grid.halo(state.filling) if self.scheme.contact_law.has_contact else None
        how = {"filling": filling, "storage": self.storage, "gaps": self.gaps}
        evaluation = Evaluation(p, H, status, grid.mesh, self.flowing, self.scheme, **how)
        _ = evaluation.inflow
        return evaluation

    def march_contents(self, state, evaluation):
        """Give the cavities that feed nothing what flows into them, in place; return the new evaluation.
        Where bodies may overlap nothing can be said of contents: there cavities count as full."""
        if not self.scheme.contact_law.has_contact:
            fills = (state.status == CAVITATED) & (evaluation.inflow > 0.0)
            state.filling = np.where(fills, OVERFULL, 1.0)
            return evaluation
        marched = self.marched(state.status)
        if not self.grid.count(marched):
            return evaluation
        along, across = evaluation.carried_by_full_gaps()
        leaving = np.pad(along, ((0, 0), (0, 1))), across[1:]
        kept = np.zeros(state.P.shape) if self.storage is None else self.storage.of_full(evaluation.fluid)
        rise = self._in_order(missing_fillings, marched, evaluation.inflow, *leaving, kept)
        state.filling = np.clip(state.filling + rise, 0.0, OVERFULL)
        return evaluation.filled(self.grid.halo(state.filling))

    def marched(self, status):
        """Cavities whose content follows from what flows into them, (lines, nx)."""
        return (status == CAVITATED) & ~self.feeding(status)

    def _closed(self, status):
        """Nodes that nothing is carried into, (lines, nx)."""
        stops = self.scheme.contact_law.closes_faces and self.scheme.couette_at_interface == "closed"
        return (status == CONTACT) & stops

    def feeding(self, status):
        """Cavities whose content reaches film or contact, (lines, nx)."""
        if not self.scheme.contact_law.has_contact or self.scheme.motion == AT_REST:
            return np.zeros(status.shape, dtype=bool)
        return self._in_order(feeding, status == CAVITATED, self._receives(status), self._along_y)

    def passed_on(self, gives, takes):
        """The nodes that give, and those that take behind them, along the axis that the surfaces move most
        along: masks (lines, nx), the first a part of the second."""
        fastest = max(self.axes, key=lambda axis: axis.couette / axis.cell)
        return self._in_order(passed_on, gives, takes, fastest.number)

    def _receives(self, status):
        """Nodes into which the contents of cavities are carried, (lines, nx)."""
        return (status == LUBRICATED) | (status == CONTACT) & ~self._closed(status)

    @property
    def _along_y(self):
        return any(axis.couette != 0.0 for axis in self.axes[1:])

    def _in_order(self, function, *arguments):
        """What a function of whole arrays that goes along the motion gives; of its own lines alone where
        the surfaces move along the lines."""
        grid = self.grid
        if not self._along_y or grid.comm.size == 1:
            return function(*arguments)
        whole = [grid.gather(each) if isinstance(each, np.ndarray) else each for each in arguments]
        return grid.scatter(function(*whole) if grid.comm.rank == 0 else None)

    def ghosted(self, state):
        """P, H and status of a state with the neighbours' lines."""
        grid = self.grid
        return grid.halo(state.P), grid.halo(state.H), grid.halo_status(state.status)

    def rows(self, status):
        """The kind of row of every node, (lines, nx)."""
        return rows_of(status, self.feeding(status))

    def residual(self, evaluation, status):
        """Rows of the nonlinear residual, (lines, nx), by what the nodes are now."""
        return residual(evaluation, self.rows(status))

    def with_flow_under_contact(self, F, evaluation, status):
        """The size of a residual F, (lines, nx), where contact has a flow balance besides: of both."""
        if self.scheme.contact_law.closes_faces:
            return F
        return np.hypot(F, np.where(status == CONTACT, evaluation.inflow, 0.0))

    def rounding(self, evaluation, status):
        """Rms residual that the last digits of the pressures may leave, without a convolution."""
        stencil = linearise(evaluation, self.rows(status))
        terms = zip(stencil.offsets, stencil.A, strict=True)
        most = sum(np.abs(A * shifted(evaluation.P, tuple(offset))) for offset, A in terms)
        return self.rms(np.finfo(float).eps * most)

    def rms(self, F):
        """Root mean square of a residual over all nodes."""
        return float(np.sqrt(self.grid.sum(np.vdot(F, F)) / self.grid.mesh.nodes))

    def load(self, P):
        """Integral of P  [Liu eq. 50]."""
        mesh = self.grid.mesh
        return mesh.dX * mesh.dY * self.grid.sum(P.sum())


class ContactProblem(Problem):
    """Gap, residual and load balance of a loaded contact on one grid."""

    load_share = 1.0
    """Load of the instant, over that of the contact."""
    resistance, H0_before = 0.0, 0.0
    """Of the step in time, as `Beyond` tells: the load on what is squeezed out beyond the domain,
    over what H0 falls by, and the H0 from which it falls."""

    def __init__(self, grid, deflection, contact, scheme):
        super().__init__(grid, contact, scheme)
        self.deflection = deflection
        self.K00 = influence_coefficients(grid.mesh, contact.kernel, 0, 1)[0, 0]
        self._centre = weights_of_centre(grid.mesh)[grid.first : grid.last]
        self.undeformed = contact.undeformed_gap(grid.X, grid.Y)
        self._load_within = contact.load_within(grid.mesh)

    @property
    def heights(self):
        """Heights at the local nodes in m, as the surfaces are now: (lines, nx); None of smooth bodies."""
        grid, contact = self.grid, self.surfaced
        if contact.surface is None:
            return None
        found = contact.surface.height(grid.X * contact.x_scale, grid.Y * contact.y_scale)
        return np.array(np.broadcast_to(found, grid.shape))

    def turn_to(self, surfaces, there, sense=1.0):
        """Take another time's surfaces, of the contact `surfaces`, and load, motion and oil of `there`,
        which moves the other way with a `sense` of -1."""
        contact = self.contact
        friction = contact.friction.slowed(there.speed / contact.speed)
        self.flowing = replace(contact.turned(there.angle), lubricant=there.lubricant, friction=friction)
        if surfaces.surface is not self.surfaced.surface:
            self.undeformed = surfaces.undeformed_gap(self.grid.X, self.grid.Y)
            self.surfaced = surfaces
        self.load_share = there.load / contact.load
        self._load_within = contact.load_within(self.grid.mesh, there, sense)

    def moving(self, speed):
        """The same problem, of the contact with the oil and the direction of now, at a `speed` in m/s,
        negative against the direction."""
        there = copy(self)
        there.contact = replace(self.flowing, friction=self.contact.friction, speed=abs(speed))
        there.sense = -1.0 if speed < 0.0 else 1.0
        return there

    @property
    def hertz(self):
        """The `HertzUnder` of load and surfaces as they are now."""
        return self.surfaced.hertz_under(self.load_share)

    def gap(self, P, H0):
        """H of [Liu eq. 48] under the pressure P; one convolution."""
        return self.deflection(P) + (self.undeformed + H0)

    def touching(self, P):
        """H0 with which the dry bodies would touch under the first guess P of a pressure."""
        if self.contact.is_hertzian:
            return -self.contact.approach
        gap = self.gap(np.where(self.boundary, 0.0, P), 0.0)
        return -self.grid.min(gap[P > 0.0])

    def state(self, P, H0, status, p=None, filling=None):
        """The state of a given pressure, with its gap; boundary nodes are set. Unless they are given, the
        fluid presses as hard as contact does, and cavities are full."""
        P = np.where(self.boundary, 0.0, P)
        status = np.where(self.boundary, BOUNDARY, status).astype(np.int8)
        H = self.gap(P, H0)
        p = P.copy() if p is None else np.where(status == CONTACT, np.clip(p, self.contact.tears_at, P), P)
        filling = np.ones(P.shape) if filling is None else np.clip(filling, 0.0, 1.0)
        return State(P, H0, H, status, p, filling)

    def status_of(self, P, in_contact):
        """The status of nodes whose pressure P is another solution's: contact where that has more than half
        of it (a part of 1), film or cavity as P says."""
        film = np.where((P > self.contact.tears_at) | (not self.scheme.cavitation), LUBRICATED, CAVITATED)
        touching = (in_contact > 0.5) & self.scheme.contact_law.has_contact
        return np.where(touching, CONTACT, film).astype(np.int8)

    def with_own_gap(self, state):
        """A state of this problem with the pressures, statuses and contents of another one's."""
        return self.state(state.P, state.H0, state.status, state.p, state.filling)

    def load_deficit(self, P, H0=0.0):
        """Integral of P minus the load that the domain carries  [Liu eq. 50]; at an H0, in time."""
        return self.load(P) - self._load_within + self.squeezed_beyond(H0)

    def squeezed_beyond(self, H0):
        """The load that oil carries beyond the domain where the step that is taken squeezes it out, in
        units of the integral of P."""
        return self.resistance_at(H0) * (self.H0_before - H0)

    def resistance_at(self, H0):
        """The resistance at an H0: of bodies that part none, where film tears as soon as it is sucked."""
        parts = H0 > self.H0_before and not self.contact.held
        return 0.0 if parts else self.resistance

    def share_of_load(self, P, nodes):
        """Part of the load as it is now that some nodes carry, a mask (lines, nx)."""
        return self.load(np.where(nodes, P, 0.0)) / self.hertz.integral

    def carrying(self, P):
        """The pressure times what makes it carry the domain's load."""
        return P * (self._load_within / self.load(P))

    def mean(self, array, nodes):
        """Mean of an array (lines, nx) over some nodes of all ranks; nan where there are none."""
        count = self.grid.count(nodes)
        return self.grid.sum(array[nodes].sum()) / count if count else nan

    def films(self, state):
        """Gap at the centre, if need be between nodes, and the smallest gap of a node, in units of H."""
        return self.grid.sum(np.vdot(self._centre, state.H)), self.grid.min(state.H)

    def counts(self, status):
        """Numbers of contact and of cavitated nodes."""
        return self.grid.count(status == CONTACT), self.grid.count(status == CAVITATED)
