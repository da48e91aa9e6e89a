"""A solution that makes oil is solved on.

The tolerance is a part of what the surfaces could carry. Where layers alone let oil through, far less
flows, and what a small residual makes may be much of it.
"""

from dataclasses import replace

from mgehl.solver.mass import mass_account
from mgehl.solver.on_grid import solve_near

AIM = 1e-8
"""Part of what flows through that nodes may make."""

FINER, ROUNDS, STEPS = 0.1, 4, 5
"""Of a residual that makes more: what is solved for then; how often, and in how many steps, at the most:
rounding may not let it fall so far."""


def close_account(task, problem, outcome):
    """The `Outcome` of the solved problem of a `Task`, its account of the oil closed as far as it can be
    (collective). Where contact shuts its faces the residual says all."""
    news, continuous = "solved on, until no node makes oil", problem.scheme.contact_law.is_continuous
    for _ in range(ROUNDS):
        if not (outcome.converged and continuous and _makes_oil(problem, outcome.state)):
            break
        limits = {"tolerance": FINER * outcome.cycles[-1].residual, "max_steps": STEPS}
        found = solve_near(task, problem, outcome.state.copy(), news, **limits)
        if not (found.converged or _is_nearer(found.cycles[-1], outcome.cycles[-1])):
            break
        outcome = replace(found, converged=True, reason=outcome.reason, begins=outcome.begins)
        if not found.converged:
            break
    return outcome


def _is_nearer(found, before):
    """Whether rounding alone ended a solve: its last `Cycle` has settled sets, and less is left."""
    left, was = (max(each.residual, abs(each.load_error)) for each in (found, before))
    return found.changes.total == 0 and left < was


def _makes_oil(problem, state):
    return mass_account(problem, state, problem.evaluate(state)).made_share > AIM
