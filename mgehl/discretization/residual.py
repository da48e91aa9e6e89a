"""The nonlinear residual, one row for each status, and its linearisation.

    lubricated           net inflow/(dX dY)   [Liu eq. 35]
    boundary, cavitated  -P/dX
    contact              -H/dX                (the scale of the Couette term)

The Jacobian is J = A + B K: A and B are stencils on P and on H, K is the deflection by P.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization import couette
from mgehl.discretization.faces import x_flows, y_flows
from mgehl.discretization.fluid import fluid_state
from mgehl.discretization.status import CONTACT, LUBRICATED

STENCIL = (WW, W, C, E, S, N) = range(6)
"""Stencil positions: two upstream nodes, centre, downstream node, lines before and after."""


@dataclass(frozen=True)
class Scheme:
    """How the Reynolds equation is differenced."""

    couette: str = "1B"
    face_mobility: str = "arithmetic"


@dataclass
class Linearisation:
    """Stencil coefficients of the Jacobian, each (6, lines, nx), ordered as `STENCIL`."""

    A: np.ndarray
    B: np.ndarray


def net_inflow(P, H, status, mesh, contact, scheme):
    """Net inflow/(dX dY) of every inner node, whatever its status: shape (lines, nx).

    `P`, `H`, `status` are ghosted. Nodes beside a line's ends get zero.
    """
    fluid = fluid_state(P, H, contact)
    leaving, entering = x_flows(fluid[1:-1], status[1:-1], mesh, scheme.couette, scheme.face_mobility)
    across = y_flows(fluid, status, mesh, scheme.face_mobility).value
    inflow = (across[:-1] - across[1:]) / mesh.dY
    inflow[:, 1:-1] += (entering.value[:, :-1] - leaving.value[:, 1:]) / mesh.dX
    inflow[:, [0, -1]] = 0.0
    return inflow


def residual(inflow, P, H, status, mesh):
    """The row of the nonlinear residual that each node's status asks for.

    All arguments (lines, nx), without ghosts; `inflow` from `net_inflow`.
    """
    F = np.where(status == LUBRICATED, inflow, -P / mesh.dX)
    contact = status == CONTACT
    F[contact] = -H[contact] / mesh.dX
    return F


def linearise(P, H, status, mesh, contact, scheme, rigid=False):
    """Derivatives of `residual` by P (A) and by H (B); arguments ghosted.

    With a `rigid` gap contact pressures are given, as on the boundary: row -P/dX.
    """
    fluid = fluid_state(P, H, contact)
    inner = status[1:-1]
    leaving, entering = x_flows(fluid[1:-1], inner, mesh, scheme.couette, scheme.face_mobility, True)
    across = y_flows(fluid, status, mesh, scheme.face_mobility, True)
    lubricated = inner == LUBRICATED
    A = _difference(leaving.by_P, entering.by_P, across.by_P, mesh)
    B = _difference(leaving.by_H, entering.by_H, across.by_H, mesh)
    A *= lubricated
    B *= lubricated
    contact_nodes = (inner == CONTACT) & (not rigid)
    A[C] -= ~(lubricated | contact_nodes) / mesh.dX
    B[C] -= contact_nodes / mesh.dX
    return Linearisation(A, B)


def _difference(leaving, entering, across, mesh):
    """Stencil of (entering - leaving)/dX + (before - after)/dY from face derivatives."""
    lines, faces = leaving[0].shape
    stencil = np.zeros((6, lines, faces + 1))
    # Through its west face node i receives `entering`, whose W is node i - 1 and WW is i - 2 ...
    for position, node in ((WW, couette.WW), (W, couette.W), (C, couette.E)):
        stencil[position, :, 1:-1] += entering[node][:, :-1] / mesh.dX
    # ... and through its east face it loses `leaving`, whose W is node i itself.
    for position, node in ((W, couette.WW), (C, couette.W), (E, couette.E)):
        stencil[position, :, 1:-1] -= leaving[node][:, 1:] / mesh.dX
    stencil[S] = across[couette.W][:-1] / mesh.dY
    stencil[C] += (across[couette.E][:-1] - across[couette.W][1:]) / mesh.dY
    stencil[N] = -across[couette.E][1:] / mesh.dY
    return stencil
