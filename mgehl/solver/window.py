"""A few nodes of a contact as a problem of their own: all around them stands still.

Its Jacobian is dense. Under contact p has a row of its own, the flow balance (`residual.Leak`):

    [ A + B K    C ]   rows of the free nodes      columns: P, or what a cavity holds
    [ R + S K    L ]   flow under contact          columns: p under contact
"""

from dataclasses import dataclass

import numpy as np
from mpi4py import MPI
from scipy.ndimage import maximum_filter
from scipy.sparse import csr_matrix

from mgehl.discretization.axes import own
from mgehl.discretization.contents import feeding
from mgehl.discretization.evaluation import Evaluation
from mgehl.discretization.mesh import Mesh
from mgehl.discretization.residual import linearise
from mgehl.discretization.rows import GAP, PRESSURE
from mgehl.discretization.status import CAVITATED, LUBRICATED
from mgehl.discretization.storage import Storage
from mgehl.grid.grid import Grid
from mgehl.solver.layers import by_reduced_pressure
from mgehl.solver.partition import Changes, Partition
from mgehl.solver.problem import Problem, State
from mgehl.solver.squeeze import squeeze_rates
from mgehl.solver.step_length import LARGEST_CHANGE, SMALLEST

RING = 3
"""Nodes around the free ones that stand still: flows look two nodes far, and one more node is judged."""


class _Alone(Grid):
    """The grid of a window: no other rank has lines of it, and it needs no DMDA."""

    def __init__(self, mesh):
        super().__init__(mesh, [0, mesh.ny], MPI.COMM_SELF)

    def _create_dm(self):
        """There are no lines to exchange."""


@dataclass(frozen=True)
class Measured:
    """A state of a window, and how far it is from an answer."""

    state: State
    evaluation: Evaluation
    rows: np.ndarray
    F: np.ndarray
    """The residual, (lines, nx)."""
    size: float
    """Its root of the sum of squares, with the flow under contact."""


class Window(Problem):
    """The nodes of a box, (lines, nx), some of which are `free`: none within `RING` of its inner sides.
    `feeds` are cavities that feed something; `K` is the influence of a node by lines and nodes between."""

    def __init__(self, problem, K, free, feeds):
        (lines, nx), mesh = free.shape, problem.grid.mesh
        ends = (0.0, (nx - 1) * mesh.dX), (0.0, (lines - 1) * mesh.dY)
        super().__init__(_Alone(Mesh(nx, lines, *ends, mesh.k_e)), problem.contact, problem.scheme)
        self.flowing, self.K00, self.free = problem.flowing, problem.K00, free
        self._feeds_beyond = feeds & ~free
        j, i = (each.ravel() for each in np.indices(free.shape))
        self._K = K[np.abs(j[:, None] - j), np.abs(i[:, None] - i)]
        self._judged = _within(free)
        self._partition = Partition(self)

    def feeding(self, status):
        """As of a `Problem`: free cavities that feed what is within, or cavities beyond that do."""
        receives = self._receives(status) | self._feeds_beyond
        return feeding((status == CAVITATED) & self.free, receives, self._along_y)

    def marched(self, status):
        return super().marched(status) & self.free

    def forget(self):
        """Nodes are as before the first step."""
        self._partition.forget()

    def measured(self, state):
        """A state `Measured`; contents that are marched are set in place."""
        evaluation = self.march_contents(state, self.evaluate(state))
        F = self.residual(evaluation, state.status)
        left = self.with_flow_under_contact(F, evaluation, state.status)[self._judged]
        return Measured(state, evaluation, self.rows(state.status), F, float(np.sqrt(np.vdot(left, left))))

    def step(self, at, settings, in_turn):
        """A `State` one Newton step from the one `Measured`, and how many nodes changed sets. None and 0
        where there is no step. `settings` are `NewtonSettings`; sets change as in a `Partition`."""
        correction = self._correction(at, settings)
        if correction is None:
            return None, 0
        c, dp, contact = correction
        old, new, changes = at.state, at.state.copy(), Changes()
        dP = np.where(self.feeding(old.status), 0.0, c)
        length = self._length(old, dP, settings.max_pressure_step)
        new.P -= length * dP
        new.filling -= length * (c - dP)
        fluid = at.evaluation.fluid
        stiffening = -own(fluid.deps_dP)[contact] / own(fluid.eps)[contact]
        new.p[contact] += by_reduced_pressure(-length * dp, stiffening, settings.passes_on)
        self._partition.cut_tension(new, changes, in_turn)
        self._hold(new, old)
        new.H = old.H + self._deflection(new.P - old.P)
        self._partition.follow_gap(new, changes, in_turn)
        self._hold(new, old)
        return new, changes.total

    def _deflection(self, P):
        return (self._K @ P.ravel()).reshape(P.shape)

    def _length(self, state, dP, most):
        """The part of a step that is taken: no film changes by more than `LARGEST_CHANGE` of itself, no
        pressure by more than `most` of the largest."""
        film = self.free & (state.status == LUBRICATED) & (state.H > self.scheme.contact_law.contact_gap)
        opens = np.max(np.abs(self._deflection(dP)[film]) / state.H[film], initial=SMALLEST)
        presses = max(np.max(np.abs(dP)), SMALLEST) / max(1.0, np.max(state.P))
        return min(1.0, LARGEST_CHANGE / opens, most / presses)

    def _hold(self, new, old):
        """What is not free stays as it was, in place."""
        for name in ("P", "p", "filling", "status"):
            getattr(new, name)[~self.free] = getattr(old, name)[~self.free]

    def _correction(self, at, settings):
        """Of P or contents, (lines, nx), and of p under contact, with where that is; None where the linear
        system has no answer."""
        unknown = self.free & (at.rows != PRESSURE)
        contact = unknown & (at.rows == GAP)
        rates = squeeze_rates(self, at.evaluation, at.rows, at.F * self.free, settings)
        rest = np.concatenate([at.F[unknown], at.evaluation.inflow[contact]])
        try:
            found = np.linalg.solve(self._jacobian(at, unknown, contact, rates), rest)
        except np.linalg.LinAlgError:
            return None
        if not np.isfinite(found).all():
            return None
        c, count = np.zeros(unknown.shape), np.count_nonzero(unknown)
        c[unknown] = found[:count]
        return c, found[count:], contact

    def _jacobian(self, at, unknown, contact, rates):
        """The dense Jacobian of the nodes that have an `unknown`, and of p under `contact`: masks."""
        storage = Storage.begun(at.evaluation.fluid, rates)
        lin = linearise(at.evaluation, at.rows, storage, leaks=True)
        here, presses = np.flatnonzero(unknown), (unknown & ~self.feeding(at.state.status)).ravel()
        K = self._K[:, here] * presses[here]
        film = self._rows(lin, lin.by_unknown, here).toarray()[:, here] + self._rows(lin, lin.B, here) @ K
        if not contact.any():
            return film
        touching, leak = np.flatnonzero(contact), lin.leak
        by_answer, by_gap = (self._spread(each, leak.nodes) for each in (leak.A, leak.B))
        by_answer = self._rows(lin, by_answer, touching).toarray()
        # What is unknown at nodes under contact does not answer to the flow: p does.
        into = by_answer[:, here] * ~contact.ravel()[here] + self._rows(lin, by_gap, touching) @ K
        out = self._rows(lin, leak.into, here).toarray()[:, touching]
        return np.block([[film, out], [into, by_answer[:, touching]]])

    def _spread(self, values, nodes):
        """Values (offsets, nodes) of some nodes, a mask, as a stencil of all."""
        stencil = np.zeros((len(values), *nodes.shape))
        stencil[:, nodes] = values
        return stencil

    def _rows(self, lin, stencil, rows):
        """Rows of a linearisation's `stencil`, (offsets, lines, nx), as a sparse matrix of the window's
        nodes; `rows` are numbers of nodes."""
        lines, nx = self.free.shape
        line, node = lin.offsets.T
        j, i = (place[:, None] + by for place, by in zip(np.divmod(rows, nx), (line, node), strict=True))
        inside = (j >= 0) & (j < lines) & (i >= 0) & (i < nx)
        entries = np.where(inside, stencil.reshape(len(stencil), -1)[:, rows].T, 0.0)
        columns, ends = np.where(inside, j * nx + i, 0), np.arange(len(rows) + 1) * len(stencil)
        return csr_matrix((entries.ravel(), columns.ravel(), ends), shape=(len(rows), self.free.size))


def _within(free):
    """The free nodes and those beside them."""
    return maximum_filter(free, size=3)
