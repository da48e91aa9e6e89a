"""The bordered Jacobian on one grid, [ A + B K, B 1; s^T, -r ]; s = load weight x dX dY, r is a resistance.

K is the full convolution, never truncated or assembled. A bordered vector holds the rank's lines of P and,
on the last rank, one entry more for H0 (or for the load row).
"""

import numpy as np
from petsc4py import PETSc

from mgehl.discretization.axes import own
from mgehl.discretization.kernels import apply_jacobian
from mgehl.discretization.residual import linearise, shifted
from mgehl.discretization.rows import FLOW, PRESSURE
from mgehl.discretization.status import CONTACT
from mgehl.discretization.storage import Storage
from mgehl.grid.events import ASSEMBLY, event
from mgehl.model.contact import RESOLVED_CELLS
from mgehl.multigrid.under_contact import UnderContact


class BorderedSpace:
    """Vectors (P, H0) on a grid, over all ranks, of which the last one always has lines."""

    def __init__(self, grid):
        self.grid = grid
        self.owns_border = grid.comm.rank == grid.comm.size - 1
        """Whether this is the last rank, which has the entry of H0, or of the load."""
        self.local_size = grid.shape[0] * grid.shape[1] + int(self.owns_border)

    def create_vec(self):
        """A new vector of this space."""
        return PETSc.Vec().createMPI((self.local_size, PETSc.DECIDE), comm=self.grid.comm)

    def read(self, vec):
        """Return the pressure part, a view (lines, nx), and the border entry on every rank."""
        P, border = self.read_own(vec)
        return P, _sent_from_last(self.grid.comm, border)

    def border_in_team(self, border):
        """The last rank's border entry on every rank with lines."""
        return _sent_from_last(self.grid.team, border) if self.grid.has_lines else border

    def read_own(self, vec):
        """As `read` without a message: the border entry is that of the last rank, and 0 on the others."""
        return self._own_parts(vec.getArray(readonly=True))

    def read_pressure(self, vec):
        """The pressure part alone, a view (lines, nx): no rank needs to ask another."""
        return self._lines(vec.getArray(readonly=True))

    def write(self, vec, P, border):
        """Set a vector from its pressure part and its border entry."""
        self.fill(vec.getArray(), P, border)

    def write_pressure(self, vec, P):
        """Set the pressure part alone."""
        self._lines(vec.getArray())[:] = P

    def parts_in_team(self, entries):
        """The pressure part of an array of own entries, a view (lines, nx), and the border entry. Where
        ranks have lines; 0 on the others."""
        P, border = self._own_parts(entries)
        return P, self.border_in_team(border)

    def _own_parts(self, entries):
        """The same without a message: the border entry is 0 on all ranks but the last."""
        return self._lines(entries), float(entries[-1]) if self.owns_border else 0.0

    def fill(self, entries, P, border):
        """Set an array of a rank's own entries from its pressure part and the border entry."""
        self._lines(entries)[:] = P
        if self.owns_border:
            entries[-1] = border

    def parts(self, stack):
        """Of many arrays of own entries, (k, own entries): those of P, (k, lines, nx), and the border's.
        The border's k entries are a list that every rank knows (collective)."""
        last, inner = self.grid.comm.size - 1, self.grid.shape[0] * self.grid.shape[1]
        borders = self.grid.comm.bcast(stack[:, inner:].ravel().tolist(), root=last)
        return stack[:, :inner].reshape(-1, *self.grid.shape), borders

    def stack(self, P, borders):
        """The arrays of own entries, (k, own entries), whose `parts` these are."""
        flat = P.reshape(len(P), -1)
        return np.column_stack([flat, borders]) if self.owns_border else flat

    def _lines(self, values):
        return values[: self.grid.shape[0] * self.grid.shape[1]].reshape(self.grid.shape)


def _sent_from_last(comm, number):
    """The last rank's number on all."""
    sent = np.array(number)
    comm.Bcast(sent, root=comm.size - 1)
    return float(sent)


class Jacobian:
    """Python context of the bordered Jacobian's Mat."""

    def __init__(self, grid, deflection, contact, scheme):
        self.grid, self.space = grid, BorderedSpace(grid)
        self.deflection, self.scheme, self.contact = deflection, scheme, contact
        mesh = grid.mesh
        # One load row against nx ny others: with this weight the norm of the bordered residual
        # sees a load error as it sees an rms residual of that size.
        self.load_scale = np.sqrt(mesh.nodes)
        self.load_weight = mesh.dX * mesh.dY * self.load_scale
        self.linearisation = None
        self.given = None
        """Where the pressure is given in it and nothing else is unknown, (lines, nx)."""
        self.contents = None
        """Where a content is unknown in it, (lines, nx); None: nowhere."""
        self.under_contact = None
        """The fluid's pressure there, eliminated; None where there is no such unknown."""
        self.resistance = 0.0
        """What the load within the domain answers to H0 by itself: oil is squeezed out beyond it."""
        self.witness = None
        """Called with (dP, dH, dH0) of every product, dH the deflection by dP."""
        self._dP = np.zeros(grid.ghosted_shape)
        self._dH = np.zeros(grid.ghosted_shape)
        self._out = np.zeros(grid.shape)
        size = (self.space.local_size, PETSc.DECIDE)
        self.mat = PETSc.Mat().createPython((size, size), self, comm=grid.comm)
        self.mat.setUp()

    @property
    def holds_film(self):
        """Whether the grid has the cells in the inlet that a film needs."""
        return self.contact.inlet_cells(self.grid.mesh) >= RESOLVED_CELLS

    @event(ASSEMBLY)
    def linearise(self, evaluation, rows, rate=0.0, leaks=False):
        """Linearise about an evaluated state with these kinds of rows, for time steps 1/`rate` long.

        In the arrays of the linearisation before, which nobody may need any more. Where it `leaks`, contact
        that closes no faces has a flow balance, too.
        """
        storage, room = Storage.begun(evaluation.fluid, rate), self.linearisation
        self.linearisation = linearise(evaluation.by(self.scheme), rows, storage, room=room, leaks=leaks)
        self.given, torn = rows == PRESSURE, evaluation.fluid.torn
        contents = (rows == FLOW) & (torn is not None and own(torn))
        self.contents = contents if self.grid.count(contents) else None  # on all ranks, or on none
        if self.contents is None:
            self.linearisation.carried = None
        self.under_contact = None
        if self.linearisation.leak is not None and self.grid.has_lines:
            touching = evaluation.status == CONTACT
            self.under_contact = UnderContact(self.grid, self.linearisation, touching)
        self.mat.stateIncrease()

    def pressures(self, x):
        """Of corrections (lines, nx) those of pressures: what the bodies feel."""
        return x if self.contents is None else np.where(self.contents, 0.0, x)

    def forget(self):
        """Free the memory of the linearisation."""
        self.linearisation = None

    def mult(self, _mat, x, y):
        """y = J x; one convolution."""
        dP, dH0 = self.space.parts_in_team(x.getArray(readonly=True))
        load = self.load_of(dP, dH0)
        dH = self.deflection(self.pressures(dP))
        if self.witness:
            self.witness(dP, dH, dH0)
        self.space.write(y, self.product(dP, dH, dH0), load)

    def load_of(self, dP, dH0):
        """s^T dP - r dH0: what corrections of P, (lines, nx), and of H0 add to the load's row; known to
        ranks with lines only."""
        carried = self.load_weight * self.grid.sum_of_team(self.pressures(dP).sum())
        return carried - self.load_scale * self.resistance * dH0

    def product(self, dP, dH, dH0):
        """A dP + B (dH + dH0), (lines, nx), of a known deflection `dH`; the next call overwrites it."""
        grid, lin = self.grid, self.linearisation
        grid.halo(dP, out=self._dP)
        grid.halo(dH, out=self._dH)
        apply_jacobian(lin.offsets, lin.A, lin.B, self._dP, self._dH, dH0, self._out)
        if lin.carried is not None:
            for offset, derivative in lin.carried.items():
                self._out += derivative * shifted(self._dP, offset)
        if self.under_contact is not None:
            self.under_contact.subtract(self._out, self._dP, self._dH, dH0)
        return self._out
