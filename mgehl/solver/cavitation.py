"""The cavitation boundary with the gap held fixed: no convolution.

A Newton step moves the boundary by one layer of nodes, and the far field alone may need dozens.
Where Poiseuille flow dominates, H hardly depends on P, so the complementarity problem
P >= 0, net inflow <= 0 can be solved there at the present gap, by projected line sweeps.
"""

from dataclasses import dataclass

import numpy as np

from mgehl.discretization.faces import conductances
from mgehl.discretization.fluid import fluid_state
from mgehl.discretization.kernels import flow_sources, relax_cavitation
from mgehl.discretization.status import CAVITATED, LUBRICATED

WEAKLY_COUPLED = 10.0
"""A node is relaxed where its mobility/dX exceeds this multiple of its own influence."""

LONG_WAVES = 0.01
"""Smallest mobility of a relaxed node on a single line: there the grid is fine enough for waves of
many cells to be strongly coupled where neighbours are not, and Newton's steps and these would chase
each other (thick films on 4097 nodes; a plane of 2049 by 2049 nodes does without, in fewer steps)."""

LIFTED = 0.1
"""A node is not treated in a gap held fixed where its blocked flow lifts that gap by more than this part:
beside contact gap and pressure would take turns for ever (2049 nodes: 0.35 a step), and by a mean of
the mobility that vanishes with the film's no pressure drives the flow out of the gap as it is."""

SWEEPS = 40
"""Sweeps over all lines at the most; they end when one changes no status."""

PASSES = 2
"""Set iterations on a line in each sweep."""


@dataclass(frozen=True)
class SplitFlow:
    """The net inflow of the nodes as source + L P, with the Poiseuille flow's L at the present state."""

    P: np.ndarray
    """Ghosted, a copy."""
    eps: np.ndarray
    """Mobility, (lines, nx)."""
    along: np.ndarray
    across: np.ndarray
    """Conductances of the x and y faces, as `conductances` gives them."""
    source: np.ndarray
    """What the surfaces carry in, (lines, nx)."""

    @property
    def conductance(self):
        """Sum over the faces of every node, (lines, nx)."""
        total = self.across[:-1] + self.across[1:]
        total[:, 1:] += self.along
        total[:, :-1] += self.along
        return total


def split_flow(problem, state, inflow):
    """The `inflow` of a state split into what the surfaces carry and what the pressure drives."""
    grid = problem.grid
    P, H, status = grid.halo(state.P), grid.halo(state.H), grid.halo_status(state.status)
    eps = fluid_state(P, H, problem.contact, problem.scheme.gap_floor).eps
    along, across = conductances(eps, status, grid.mesh, problem.scheme)
    source = np.zeros(grid.shape)
    flow_sources(inflow, P, along, across, source)
    return SplitFlow(P, eps[1:-1], along, across, source)


def relax_cavitation_set(problem, state, flow):
    """Relax P and status of the weakly coupled fluid; return the number of nodes that changed.

    `flow` is the `SplitFlow` of `state`, whose pressures it uses up. Updates `state` in place, but
    only if the set moved: otherwise Newton's pressures stand. Zebra order by global line number, so
    the number of ranks does not matter.
    """
    if not problem.scheme.cavitation:
        return 0
    grid = problem.grid
    P, faces = flow.P, (flow.source, flow.along, flow.across)
    movable = _relaxable(problem, flow, state)
    lubricated = state.status == LUBRICATED
    for _ in range(SWEEPS):
        changes = 0
        for colour in (0, 1):
            first = (colour + grid.first) % 2
            changes += relax_cavitation(first, P, lubricated, movable, *faces, PASSES)
            grid.refresh(P)
        if grid.sum(changes) == 0:
            break
    relaxed = np.where(movable, np.where(lubricated, LUBRICATED, CAVITATED), state.status)
    moved = grid.count(relaxed != state.status)
    if moved:
        state.P[:] = P[1:-1]
        state.status[:] = relaxed
    return moved


def weakly_coupled(problem, eps, status, multiple):
    """Fluid nodes whose gap hardly answers to their pressure; all (lines, nx)."""
    fluid = (status == LUBRICATED) | (status == CAVITATED)
    return fluid & (eps > multiple * problem.K00 * problem.grid.mesh.dX)


def driven(problem, flow, H):
    """Nodes whose flow the pressure drives out of the gap as it is, hardly lifting it: (lines, nx)."""
    return problem.K00 * np.abs(flow.source) <= LIFTED * H * flow.conductance


def _relaxable(problem, flow, state):
    """Nodes that may be relaxed: as weakly coupled as that to waves of any length that matters."""
    movable = weakly_coupled(problem, flow.eps, state.status, WEAKLY_COUPLED)
    if problem.grid.mesh.is_line:
        movable &= flow.eps > LONG_WAVES
    return movable & driven(problem, flow, state.H)
