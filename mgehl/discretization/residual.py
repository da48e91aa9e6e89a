"""The nonlinear residual, a row for each node of the kind it has at the moment, and its linearisation.

The Jacobian is J = A + B K: A and B are stencils on P and on H, K is the deflection by P.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.couette import SHIFT
from mgehl.discretization.rows import FLOW, GAP, PRESSURE


@dataclass
class Linearisation:
    """Stencil coefficients of the Jacobian, A and B each (offsets, lines, nx)."""

    offsets: np.ndarray
    """(lines, nodes) from a node to those it is coupled to, (offsets, 2)."""
    A: np.ndarray
    B: np.ndarray | None
    """None of a rigid gap."""
    eps: np.ndarray
    """The nodes' mobility, (lines, nx): it tells a smoother where the Poiseuille flow is weak."""

    def turned(self, turn):
        """That of an elastic gap with X and Y exchanged; `turn` does that to an array of nodes."""
        offsets = np.ascontiguousarray(self.offsets[:, ::-1])
        return Linearisation(offsets, _turned(self.A, turn), _turned(self.B, turn), turn(self.eps))


def _turned(stencil, turn):
    """A stencil of turned arrays, one after the other: two copies of all would be the most memory."""
    first = turn(stencil[0])
    turned = np.empty((len(stencil), *first.shape))
    turned[0] = first
    for array, of_offset in zip(stencil[1:], turned[1:], strict=True):
        turn(array, of_offset)
    return turned


def residual(evaluation, rows, storage=None):
    """The row of the nonlinear residual that each node has, (lines, nx) as `rows`.

    With a `storage` the film's rows are those of an implicit time step.
    """
    dX = evaluation.mesh.dX
    inflow = evaluation.inflow if storage is None else evaluation.inflow - storage.outflow(evaluation.fluid)
    F = np.where(rows == FLOW, inflow, -own(evaluation.P) / dX)
    closed = rows == GAP
    F[closed] = (evaluation.scheme.contact_law.contact_gap - own(evaluation.H)[closed]) / dX
    return F


def linearise(evaluation, rows, storage=None, rigid=False):
    """Derivatives of `residual` by P (A) and, unless the gap is `rigid`, by H (B)."""
    fluid, found = evaluation.fluid, evaluation.linearised_flows(rigid)
    offsets = _offsets(evaluation.axes, found)
    A = _net_inflow(evaluation, offsets, found, "by_P")
    B = None if rigid else _net_inflow(evaluation, offsets, found, "by_H")
    if storage is not None:
        A[0] -= storage.by_P(fluid)
        if not rigid:
            B[0] -= storage.by_H(fluid)
    _set_given(A, rows, PRESSURE, evaluation.mesh.dX)
    if not rigid:
        _set_given(B, rows, GAP, evaluation.mesh.dX)
    return Linearisation(np.array(offsets), A, B, own(fluid.eps))


def _offsets(axes, found):
    """Where the flows into and out of a node look to, the node itself first."""
    offsets = {}
    for axis, (leaving, entering) in zip(axes, found, strict=True):
        shifts = [SHIFT[node] for node in leaving.by_P] + [SHIFT[node] - 1 for node in entering.by_P]
        offsets |= dict.fromkeys(axis.offset(shift) for shift in sorted(shifts))
    return [(0, 0), *(offset for offset in offsets if offset != (0, 0))]


def _net_inflow(evaluation, offsets, found, derivative):
    """Stencil of the net inflow from one kind of derivatives of the flows."""
    stencil = np.zeros((len(offsets), *own(evaluation.P).shape))
    position = {offset: k for k, offset in enumerate(offsets)}
    for axis, (leaving, entering) in zip(evaluation.axes, found, strict=True):
        # A node is the E of the face through which fluid enters it, and the W of the other.
        for node, array in getattr(entering, derivative).items():
            axis.add_entering(array, stencil[position[axis.offset(SHIFT[node] - 1)]])
        for node, array in getattr(leaving, derivative).items():
            axis.subtract_leaving(array, stencil[position[axis.offset(SHIFT[node])]])
    return stencil


def _set_given(stencil, rows, kind, dX):
    """In place: only the film's rows keep their flow; those of the given `kind` are -1/dX of their own."""
    stencil *= rows == FLOW
    stencil[0] -= (rows == kind) / dX
