"""How far a step in time is solved: to a part of what it begins with, until the account of the oil closes.

What a step leaves open is carried into the next one. Films hardly feel that; under contact, where stiff oil
bears all of a load before so little is out, it decides what the solids carry.
"""

from mgehl.discretization.status import CONTACT
from mgehl.discretization.storage import content
from mgehl.solver.layers import bring_to_rest

LOOSEST = 1e-4
"""Largest residual that a step may leave, however much it begins with."""

OF_LAYERS = 5e-5
"""Part of what contact's layers hold that may be left open beside them in a step, or while surfaces go a
cell, rms. With 1e-3 bodies that start from rest had half of their load on solids."""

CLOSES = 5e-9
"""Part of the oil in the domain by which a step's account may be off: half of what is promised."""

FINER = 0.03
"""Of a residual that leaves more: what is solved for then."""


class StepSolve:
    """Solves the steps of a problem by a `Newton`; `settings` are `TimeSettings`."""

    def __init__(self, problem, newton, settings):
        self._problem, self._newton, self._settings = problem, newton, settings
        law = problem.scheme.contact_law
        self._layers = law.contact_gap if law.has_contact and not law.closes_faces else None

    def solved(self, state, leg):
        """Newton's `Outcome` of a `Leg` from a guess."""
        problem, settings = self._problem, self._settings
        begun = problem.rms(problem.residual(problem.evaluate(state), state.status))
        tolerance = max(settings.least, min(settings.part * begun, self._loosest(state)))
        while True:
            outcome = self._newton.run(state, tolerance=tolerance)
            reached = outcome.cycles[-1].residual
            if outcome.converged:
                self._close(outcome.state)
            at_the_end = reached <= settings.least or reached > tolerance  # which rounding alone leaves
            if not outcome.converged or at_the_end or self._closes(outcome.state, leg):
                return outcome
            state, tolerance = outcome.state, max(settings.least, FINER * reached)

    def _loosest(self, state):
        """The largest residual that a step from a state may leave."""
        problem = self._problem
        if self._layers is None or not problem.grid.count(state.status == CONTACT):
            return LOOSEST
        rate = min(problem.storage.rate, 1.0 / problem.grid.mesh.dX)
        return min(LOOSEST, OF_LAYERS * self._layers * rate)

    def _close(self, state):
        """Bring the fluid under contact to rest, and the bodies apart, or nearer, until what a state's
        residual makes of oil in sum is nothing.

        That takes no convolution, and moves them by some 1e-8 of the film. Smaller residuals would close
        the account, too, for a third more work; films would differ by 5e-6 (ground surfaces in a film).
        """
        problem = self._problem
        if self._layers is not None:
            bring_to_rest(problem, state)
        evaluation = problem.evaluate(state)
        apart = self._sum(evaluation.inflow) / self._sum(problem.storage.by_H(evaluation.fluid))
        state.H0 += apart
        state.H += apart

    def _closes(self, state, leg):
        """Whether what a state's residual makes is little beside what there is."""
        evaluation = self._problem.evaluate(state)
        made = leg.b * leg.dT * self._sum(evaluation.inflow)
        return abs(made) <= CLOSES * self._sum(content(evaluation.fluid))

    def _sum(self, array):
        """That of the inner nodes (collective)."""
        return self._problem.grid.sum(array[~self._problem.boundary].sum())
