"""The nonlinear residual, a row for each node of its present kind, and its linearisation J = A + B K.

A and B are stencils on P and on H, K is the deflection by P. What a cavity holds is an unknown in the place
of its pressure. Under contact that closes no faces p is one more, and the balance of each (`Leak`).
"""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.axes import few_lines, own
from mgehl.discretization.faces import nodes_of_flows
from mgehl.discretization.flow import SHIFT
from mgehl.discretization.mesh import HALO
from mgehl.discretization.rows import FLOW, GAP, PRESSURE
from mgehl.discretization.status import CAVITATED, CONTACT


@dataclass
class Leak:
    """What couples the fluid's pressure under contact to the rest, (offsets, nodes) each. Of the contact
    nodes in their order; the offsets are the linearisation's."""

    nodes: np.ndarray
    """Where they are: a mask (lines, nx)."""
    A: np.ndarray
    """Derivatives of their inflow by what answers to the flow balance around them: p, or a content."""
    B: np.ndarray
    """The same by H."""
    into: np.ndarray
    """Derivatives of the rows around them by their p: of the row that sees a node at an offset, there."""


@dataclass
class Linearisation:
    """Stencil coefficients of the Jacobian, A and B each (offsets, lines, nx)."""

    offsets: np.ndarray
    """(lines, nodes) from a node to those it is coupled to, (offsets, 2)."""
    A: np.ndarray
    B: np.ndarray
    eps: np.ndarray
    """The nodes' mobility, (lines, nx): it tells a smoother where the Poiseuille flow is weak."""
    carried: dict | None = None
    """Derivatives by the contents of cavities, (lines, nx) by their offset; None without any."""
    leak: Leak | None = None

    @property
    def by_unknown(self):
        """A with the columns of the contents."""
        if self.carried is None:
            return self.A
        A = self.A.copy()
        for offset, derivative in self.carried.items():
            A[self.position(offset)] += derivative
        return A

    def position(self, offset):
        """Place of an offset."""
        return int(np.flatnonzero((self.offsets == offset).all(axis=1))[0])


def residual(evaluation, rows):
    """The row of the nonlinear residual that each node has, (lines, nx) as `rows`."""
    dX = evaluation.mesh.dX
    F = np.where(rows == FLOW, evaluation.inflow, -own(evaluation.P) / dX)
    if tears_at := evaluation.contact.tears_at:
        F[(rows == PRESSURE) & (own(evaluation.status) == CAVITATED)] += tears_at / dX
    closed = rows == GAP
    F[closed] = (evaluation.scheme.contact_law.contact_gap - own(evaluation.H)[closed]) / dX
    return F


def linearise(evaluation, rows, storage=None, room=None, leaks=False):
    """Derivatives of `residual` by P (A) and by H (B). Where it `leaks` contact nodes have a flow balance,
    too. The `storage` is all that nodes store.

    A few lines at a time, for the processor's cache. The arrays of `room`, a `Linearisation` of the same
    kind that nobody needs any more, are used again.
    """
    fluid, offsets = evaluation.fluid, _offsets(evaluation)
    A, B = (room.A, room.B) if room else np.empty((2, len(offsets), *rows.shape))
    for lines in few_lines(rows):
        part = evaluation.of_lines(lines)
        found = part.linearised_flows()
        flowing = rows[lines] == FLOW
        flowing |= (rows[lines] == GAP) & leaks
        _set_rows(A[:, lines], flowing, part, offsets, found, "by_P")
        _set_rows(B[:, lines], flowing, part, offsets, found, "by_H")
    if storage is not None:
        A[0] -= storage.by_P(fluid) * (rows == FLOW)
        B[0] -= storage.by_H(fluid) * (rows == FLOW)
    linearisation = Linearisation(np.array(offsets), A, B, own(fluid.eps))
    _sort_columns(linearisation, evaluation, rows, leaks)
    dX = evaluation.mesh.dX
    A[0] -= (rows == PRESSURE) / dX
    B[0] -= (rows == GAP) / dX
    return linearisation


def _sort_columns(linearisation, evaluation, rows, leaks):
    """Take apart, in place, what the columns of A answer to: P of film, contents, p under contact."""
    law, torn = evaluation.scheme.contact_law, evaluation.fluid.torn
    offsets = [tuple(offset) for offset in linearisation.offsets]
    if law.has_contact and not law.closes_faces:
        contact = evaluation.status == CONTACT
        closed = own(contact) & (rows == GAP)
        if leaks:
            linearisation.leak = _leak(linearisation, contact, closed)
        for offset in offsets:
            _taken(linearisation, contact, offset)
        for stencil in (linearisation.A, linearisation.B):
            stencil[:, closed] = 0.0
    if torn is not None:
        taken = {offset: _taken(linearisation, torn, offset) for offset in offsets}
        # Cavities have columns of their own, though none of them carries anything.
        linearisation.carried = {
            offset: each for offset, each in taken.items() if each.any() or offset == (0, 0)
        }


def _taken(linearisation, columns, offset):
    """What A has at an `offset` in these `columns`, a ghosted mask: (lines, nx); it is zero there after."""
    derivative = linearisation.A[linearisation.position(offset)]
    there = shifted(columns, offset)
    taken = derivative * there
    derivative[there] = 0.0
    return taken


def _leak(linearisation, contact, nodes):
    """The `Leak` of `nodes` (lines, nx) beside others in `contact`, a ghosted mask."""
    seen = [
        np.where(shifted(contact, offset) & ~nodes, A, 0.0)
        for offset, A in zip(linearisation.offsets, linearisation.A, strict=True)
    ]
    return Leak(nodes, linearisation.A[:, nodes], linearisation.B[:, nodes], np.array(seen))


def shifted(ghosted, offset):
    """A ghosted array at an `offset` (lines, nodes) from each node, (lines, nx); 0 beyond lines' ends."""
    line, node = offset
    lines, nx = own(ghosted).shape
    here = ghosted[HALO + line : HALO + line + lines]
    if node == 0:
        return here
    moved = np.zeros_like(here)
    if node > 0:
        moved[:, :-node] = here[:, node:]
    else:
        moved[:, -node:] = here[:, :node]
    return moved


def _offsets(evaluation):
    """Where the flows into and out of a node look to, the node itself first."""
    offsets = {}
    for axis in evaluation.axes:
        leaving, entering = nodes_of_flows(axis, evaluation.scheme)
        shifts = [SHIFT[node] for node in leaving] + [SHIFT[node] - 1 for node in entering]
        offsets |= dict.fromkeys(axis.offset(shift) for shift in sorted(shifts))
    return [(0, 0), *(offset for offset in offsets if offset != (0, 0))]


def _set_rows(stencil, flowing, part, offsets, found, derivative):
    """Set a stencil (offsets, lines, nx) from one kind of derivatives of the flows that were `found`. Rows
    that are `flowing` have the net inflow, others nothing."""
    stencil[:] = 0.0
    position = {offset: k for k, offset in enumerate(offsets)}
    for axis, (leaving, entering) in zip(part.axes, found, strict=True):
        # A node is the E of the face through which fluid enters it, and the W of the other.
        for node, array in getattr(entering, derivative).items():
            axis.add_entering(array, stencil[position[axis.offset(SHIFT[node] - 1)]])
        for node, array in getattr(leaving, derivative).items():
            axis.subtract_leaving(array, stencil[position[axis.offset(SHIFT[node])]])
    stencil *= flowing.astype(float)  # not bool: it would be converted once for each offset
