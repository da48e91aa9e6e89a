"""The fluid in the layers under contact: its pressure p leaves a Newton step's system, and follows it.

In time p is brought to rest besides: stiff oil is pressed out of the layers by all of a load or by none,
and what its balance leaves open, however little, would be carried on, and pressed out later.
"""

import numpy as np

from mgehl.discretization.axes import own
from mgehl.discretization.residual import linearise
from mgehl.discretization.status import CONTACT
from mgehl.multigrid.under_contact import UnderContact

ALL, NEARLY_ALL = 1.0 - np.finfo(float).eps, 0.999
"""Parts of what an infinite pressure would drive under contact that a step may ask for. No pressure drives
more than all: bare contact that is asked for it opens at once. With nearly all a film waits at each node,
and takes up to twice the work; but on lines more contacts are found."""


ROUNDS = 5
"""Rounds in which p is brought to rest at the most; two or three are usual."""

AT_REST = 1e-10
"""What the balance of contact may leave open, over what the surfaces carry in a film of a unit of H."""


def bring_to_rest(problem, state):
    """Bring p under contact to rest, in place, as far as the solids' pressure allows; all else stays as it
    is. That takes no convolution."""
    status, rows = state.status, problem.rows(state.status)
    for _ in range(ROUNDS):
        evaluation = problem.evaluate(state)
        lowest, highest = state.p <= problem.contact.tears_at, state.p >= state.P
        stays = lowest & (evaluation.inflow < 0.0) | highest & (evaluation.inflow > 0.0)
        left = np.where((status == CONTACT) & ~stays, evaluation.inflow, 0.0)
        if problem.grid.max(np.abs(left), initial=0.0) <= AT_REST / problem.grid.mesh.dX:
            break
        linearisation = linearise(evaluation, rows, leaks=True)
        layers = UnderContact(problem.grid, linearisation, evaluation.status == CONTACT)
        here, fluid = layers.here, evaluation.fluid
        stiffening = -own(fluid.deps_dP)[here] / own(fluid.eps)[here]
        asked = -layers.own(layers.solve(evaluation.inflow[here]))
        p = state.p[here] + by_reduced_pressure(asked, stiffening, at_once=False)
        state.p[here] = np.clip(p, problem.contact.tears_at, state.P[here])


class FluidInLayers:
    """p of an evaluated state, `eliminated` (an `UnderContact`) from its step's system (the team's)."""

    def __init__(self, problem, evaluation, eliminated):
        self._problem, self._fluid, self._eliminated = problem, evaluation.fluid, eliminated
        self._p = eliminated.solve(evaluation.inflow[eliminated.here])

    def leave(self, F):
        """Take what the flow balance under contact asks of p out of the right-hand side, in place."""
        self._eliminated.feed(F, -self._p)

    def follow(self, state, c, dH, length, at_once):
        """Move p along a part of the step: -c, (lines, nx), by which the gap falls by `dH`; contact
        opens `at_once` that is asked for more than any p drives."""
        grid, eliminated, here = self._problem.grid, self._eliminated, self._eliminated.here
        outside = np.where(state.status == CONTACT, 0.0, c)
        moved = eliminated.inflow(grid.halo(outside), grid.halo(dH), 0.0)
        dp = eliminated.own(self._p - eliminated.solve(moved))
        stiffening = -own(self._fluid.deps_dP)[here] / own(self._fluid.eps)[here]
        state.p[here] += by_reduced_pressure(-length * dp, stiffening, at_once)


def by_reduced_pressure(change, stiffening, at_once):
    """The change of a pressure whose fluid stiffens by e^(`stiffening` p), by that of its reduced pressure,
    in which the flow under contact is linear; at most the one that drives nearly all that any could, or all
    `at_once`."""
    steep = np.abs(stiffening * change) > 1e-8
    most = ALL if at_once else NEARLY_ALL
    with np.errstate(divide="ignore", invalid="ignore"):
        reduced = -np.log1p(-np.minimum(stiffening * change, most)) / stiffening
    return np.where(steep, reduced, change)
