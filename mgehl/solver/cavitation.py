"""The cavitation boundary with the gap held fixed, by line sweeps; one convolution for the gap afterwards.

A Newton step moves the boundary by one layer of nodes only. Where Poiseuille flow dominates, H hardly
depends on P: flow balance, P >= 0 and fillings below 1 can be solved there at the present gap.
"""

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.kernels import relax_cavitation
from mgehl.discretization.status import CAVITATED, LUBRICATED, is_fluid

WEAKLY_COUPLED = 10.0
"""A node is relaxed where its mobility/dX exceeds this multiple of its influence; 3 to 100 do as well."""

LOW = 0.1
"""Part of the largest pressure that a relaxed node has at the most: where fluid flows easily under all of
the load, relaxing it holds a wrong gap fixed. With 0.3 a wide soft roller takes seven times the work; with
0.03 partial contact of the paper's ball is lost."""

SWEEPS, QUIET = 1000, 30
"""Sweeps over all lines at the most; they end when so many, one after the other, changed no status: fewer
end before pressures have spread across the lines."""

GAINS = 0.25
"""Part of the residual that a relaxation may leave; with 0.5 thick films on rough balls take twice the
work, with 1 they walk for ever. Beside the nodes that it brings to rest others may be left with ten times
as much, and the next step throws the gap. Without any relaxation balls without layers are lost."""

PASSES = 2
"""Set iterations on a line in each sweep; with 1 most take the same steps."""


def relax_cavitation_set(problem, state):
    """Relax pressures, fillings and status of the weakly coupled fluid; return how many nodes changed.

    Updates `state` in place, its gap included, if the set moved and the residual fell, at the gap as it was
    and at the gap under the new pressures; else Newton's values stand. Steps in time would gain nothing.
    """
    if not problem.scheme.cavitation or problem.storage is not None:
        return 0
    relaxed = state.copy()
    moved = _relax(problem, relaxed)
    if not moved:
        return 0
    most = GAINS * _residual_of(problem, state)
    if _residual_of(problem, relaxed) > most:
        return 0
    # Pressures that are low each lift the bodies together: a step from the old gap would not know of it.
    relaxed.H = problem.gap(relaxed.P, relaxed.H0)
    if _residual_of(problem, relaxed) > most:
        return 0
    for name in ("P", "H", "p", "filling", "status"):
        getattr(state, name)[:] = getattr(relaxed, name)
    return moved


def _residual_of(problem, state):
    """The rms residual of a state with the contents that flow into its cavities."""
    state = state.copy()
    evaluation = problem.march_contents(state, problem.evaluate(state))
    return problem.rms(problem.residual(evaluation, state.status))


def _relax(problem, state):
    """The same in place, whatever the residual. Zebra order by global line number: ranks do not matter."""
    grid, evaluation = problem.grid, problem.evaluate(state).filled(None)
    movable = _relaxable(problem, evaluation, state)
    cavity = state.status == CAVITATED
    film, empty = ~cavity, np.maximum(1.0 - state.filling, 0.0)
    tears_at = problem.contact.tears_at
    w = grid.halo(np.where(cavity, -empty, own(evaluation.P) - tears_at))
    carried = evaluation.carried_by_full_gaps()
    if not problem.scheme.contact_law.has_contact:  # bodies may overlap: cavities count as full
        carried = tuple(np.zeros(each.shape) for each in carried)
    faces = evaluation.source, tuple(evaluation.conductances), carried
    sweeps = quiet = 0
    while sweeps < SWEEPS and quiet < QUIET:
        changes = 0
        for colour in (0, 1):
            changes += relax_cavitation((colour + grid.first) % 2, w, film, movable, *faces, PASSES)
            grid.refresh(w)
        sweeps, quiet = sweeps + 1, 0 if grid.sum(changes) else quiet + 1
    moved = grid.count(film == cavity)
    P = np.where(movable, np.maximum(own(w), 0.0) + tears_at, state.P)
    state.status[movable] = np.where(film, LUBRICATED, CAVITATED)[movable]
    state.filling[movable] = np.where(film, 1.0, 1.0 + own(w))[movable]
    state.P[:], state.p[movable] = P, P[movable]
    return moved


def overflows(state):
    """Cavities that hold more than their gap, (lines, nx)."""
    return (state.status == CAVITATED) & (state.filling > 1.0)


def weakly_coupled(problem, evaluation, status):
    """Fluid nodes whose gap hardly answers to their pressure; all (lines, nx)."""
    mobility = own(evaluation.fluid.eps)
    return is_fluid(status) & (mobility > WEAKLY_COUPLED * problem.K00 * problem.grid.mesh.dX)


def _relaxable(problem, evaluation, state):
    """Nodes of low pressure, where that hardly moves the gap."""
    movable = weakly_coupled(problem, evaluation, state.status)
    return movable & (state.P <= LOW * problem.grid.max(state.P, initial=0.0))
