"""The nonlinear residual, a row for each node of the kind it has at the moment, and its linearisation.

The Jacobian is J = A + B K: A and B are stencils on P and on H, K is the deflection by P.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.axes import few_lines, own
from mgehl.discretization.couette import SHIFT
from mgehl.discretization.faces import nodes_of_flows
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


def linearise(evaluation, rows, storage=None, rigid=False, room=None):
    """Derivatives of `residual` by P (A) and, unless the gap is `rigid`, by H (B).

    Of a few lines at a time: their flows are still in the processor's cache when they are added up. The
    arrays of `room`, a `Linearisation` of the same kind that nobody needs any more, are used again.
    """
    fluid, offsets = evaluation.fluid, _offsets(evaluation)
    A, B = (room.A, room.B) if room else _empty_stencils((len(offsets), *rows.shape), rigid)
    for lines in few_lines(rows):
        part = evaluation.of_lines(lines)
        found = part.linearised_flows(rigid)
        _set_rows(A[:, lines], rows[lines], PRESSURE, part, offsets, found, "by_P")
        if not rigid:
            _set_rows(B[:, lines], rows[lines], GAP, part, offsets, found, "by_H")
    if storage is not None:
        A[0] -= storage.by_P(fluid) * (rows == FLOW)
        if not rigid:
            B[0] -= storage.by_H(fluid) * (rows == FLOW)
    return Linearisation(np.array(offsets), A, B, own(fluid.eps))


def _empty_stencils(shape, rigid):
    return np.empty(shape), None if rigid else np.empty(shape)


def _offsets(evaluation):
    """Where the flows into and out of a node look to, the node itself first."""
    offsets = {}
    for axis in evaluation.axes:
        leaving, entering = nodes_of_flows(axis, evaluation.scheme)
        shifts = [SHIFT[node] for node in leaving] + [SHIFT[node] - 1 for node in entering]
        offsets |= dict.fromkeys(axis.offset(shift) for shift in sorted(shifts))
    return [(0, 0), *(offset for offset in offsets if offset != (0, 0))]


def _set_rows(stencil, rows, given, part, offsets, found, derivative):
    """Set a stencil (offsets, lines, nx) from one kind of derivatives of the flows that were `found`.

    Rows of the film have the net inflow, those of the `given` kind -1/dX of their own, others nothing.
    """
    stencil[:] = 0.0
    position = {offset: k for k, offset in enumerate(offsets)}
    for axis, (leaving, entering) in zip(part.axes, found, strict=True):
        # A node is the E of the face through which fluid enters it, and the W of the other.
        for node, array in getattr(entering, derivative).items():
            axis.add_entering(array, stencil[position[axis.offset(SHIFT[node] - 1)]])
        for node, array in getattr(leaving, derivative).items():
            axis.subtract_leaving(array, stencil[position[axis.offset(SHIFT[node])]])
    stencil *= (rows == FLOW).astype(float)  # not bool: it would be converted once for each offset
    stencil[0] -= (rows == given) / part.mesh.dX
