"""The nonlinear residual, one row for each status, and its linearisation.

    lubricated           net inflow/(dX dY)   [Liu eq. 35]
    boundary, cavitated  -P/dX
    contact              -H/dX                (the scale of the Couette term)

With a rigid gap the pressure of a contact node is given, too: row -P/dX. The Jacobian is
J = A + B K: A and B are stencils on P and on H, K is the deflection by P.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization import couette
from mgehl.discretization.faces import x_flows, y_flows
from mgehl.discretization.fluid import fluid_state
from mgehl.discretization.status import CONTACT, LUBRICATED

STENCIL = (WW, W, C, E, S, N) = range(6)
"""Stencil positions: two upstream nodes, centre, downstream node, lines before and after."""

# Where a node finds what it receives through its west face, whose E it is itself, and what it
# loses through its east face, whose W it is.
_ENTERING = {couette.WW: WW, couette.W: W, couette.E: C, couette.EE: E}
_LEAVING = {couette.WW: W, couette.W: C, couette.E: E}


@dataclass
class Linearisation:
    """Stencil coefficients of the Jacobian, each (6, lines, nx), ordered as `STENCIL`."""

    A: np.ndarray
    B: np.ndarray | None
    """None of a rigid gap."""
    eps: np.ndarray
    """The nodes' mobility, (lines, nx): it tells a smoother where the Poiseuille flow is weak."""


def net_inflow(P, H, status, mesh, contact, scheme):
    """Net inflow/(dX dY) of every inner node, whatever its status: shape (lines, nx).

    `P`, `H`, `status` are ghosted. Nodes beside a line's ends get zero.
    """
    fluid = fluid_state(P, H, contact, scheme.gap_floor)
    leaving, entering = x_flows(fluid[1:-1], status[1:-1], mesh, scheme)
    across = y_flows(fluid, status, mesh, scheme).value
    inflow = (across[:-1] - across[1:]) / mesh.dY
    inflow[:, 1:-1] += (entering.value[:, :-1] - leaving.value[:, 1:]) / mesh.dX
    inflow[:, [0, -1]] = 0.0
    return inflow


def residual(inflow, P, H, status, mesh, rigid=False):
    """The row of the nonlinear residual that each node's status asks for.

    All arguments (lines, nx), without ghosts; `inflow` from `net_inflow`.
    """
    F = np.where(status == LUBRICATED, inflow, -P / mesh.dX)
    if not rigid:
        contact = status == CONTACT
        F[contact] = -H[contact] / mesh.dX
    return F


def linearise(P, H, status, mesh, contact, scheme, rigid=False, squeeze=0.0):
    """Derivatives of `residual` by P (A) and, unless the gap is `rigid`, by H (B); arguments ghosted.

    With `squeeze`, a rate in 1/time step or one for each node, they are those of an implicit step
    of d(rho H)/dt: the smaller the time step, the less the gap of a film can change in it.
    """
    fluid = fluid_state(P, H, contact, scheme.gap_floor)
    inner = status[1:-1]
    leaving, entering = x_flows(fluid[1:-1], inner, mesh, scheme, True, rigid)
    across = y_flows(fluid, status, mesh, scheme, True, rigid)
    film, gap_given = inner == LUBRICATED, (inner == CONTACT) & (not rigid)
    A = _difference(leaving.by_P, entering.by_P, across.by_P, mesh)
    _set_rows(A, squeeze, (fluid.drho_dP * fluid.H)[1:-1], film, ~(film | gap_given), mesh)
    if rigid:
        return Linearisation(A, None, fluid.eps[1:-1])
    B = _difference(leaving.by_H, entering.by_H, across.by_H, mesh)
    _set_rows(B, squeeze, fluid.rho[1:-1], film, gap_given, mesh)
    return Linearisation(A, B, fluid.eps[1:-1])


def _set_rows(stencil, squeeze, stored, film, given, mesh):
    """In place: rows of the `film` also lose squeeze times what is `stored`, `given` ones are -1/dX."""
    if np.any(squeeze):
        stencil[C] -= squeeze * stored
    stencil *= film
    stencil[C] -= given / mesh.dX


def _difference(leaving, entering, across, mesh):
    """Stencil of (entering - leaving)/dX + (before - after)/dY from face derivatives."""
    lines, faces = leaving[couette.W].shape
    stencil = np.zeros((6, lines, faces + 1))
    for node, array in entering.items():
        stencil[_ENTERING[node], :, 1:-1] += array[:, :-1] / mesh.dX
    for node, array in leaving.items():
        stencil[_LEAVING[node], :, 1:-1] -= array[:, 1:] / mesh.dX
    stencil[S] = across[couette.W][:-1] / mesh.dY
    stencil[C] += (across[couette.E][:-1] - across[couette.W][1:]) / mesh.dY
    stencil[N] = -across[couette.E][1:] / mesh.dY
    return stencil
