"""Eq. 2 as the arbiter: of partitions that all satisfy the gap conditions, it takes its pick.

A state that settled is an answer. What breaks Eq. 2 in it is let go and the sets settle again: contact
pressures jump where a node opens, so the state found then may break Eq. 2 at more nodes, or not settle
at all. The one that settled with the fewest is the answer.
"""

from mgehl.solver.outcome import Answer

RELEASE_STEPS = 8
"""Steps in which a set must settle again after Eq. 2 released some of it."""

EARLY = 1e-5
"""Residual from which Eq. 2 is asked where the fluid is solved apart."""

EARLY_ROUNDS = 3
"""Releases before the last digits: 2049 nodes take two; an edge that opens node by node has no end."""


def arbitrate(partition, now, max_steps):
    """Release what breaks Eq. 2 at the end of an iteration; True where it has to settle again.

    `now.answer` becomes the state that is settled, if it is better than the one before.
    """
    outcome, now.released = now.outcome, 0
    if not outcome.converged:
        return False
    violations = partition.count_violations(outcome.state)
    if now.answer and violations >= now.answer.violations:
        outcome.converged = False
        return False
    now.answer = Answer(outcome.state.copy(), outcome.reason, violations)
    now.released, now.entered = partition.release_violations(outcome.state), 0
    now.changes.released += now.released
    now.limit = min(max_steps, outcome.cycles[-1].step + RELEASE_STEPS)
    outcome.converged = now.released == 0
    return now.released > 0


def release_early(partition, now):
    """Release what breaks Eq. 2 before the last digits; True where it did.

    Where all of the ellipse is in contact and the fluid is solved apart, what breaks Eq. 2 is
    known long before them, while a few nodes still turn: a round of release saves 3 to 5 steps.
    """
    outcome = now.outcome
    if outcome.cycles[-1].residual > EARLY or now.early_rounds == EARLY_ROUNDS:
        return False
    released = partition.release_violations(outcome.state)
    now.early_rounds += released > 0
    now.changes.released += released
    return released > 0


def closed_again(now):
    """True where as many nodes closed as Eq. 2 let go: this grid cannot satisfy it."""
    return 0 < now.released <= now.entered


def restore_answer(now):
    """Make the kept answer the outcome."""
    outcome, answer = now.outcome, now.answer
    outcome.state, outcome.converged, outcome.reason = answer.state, True, answer.reason
    outcome.contradictions = []
