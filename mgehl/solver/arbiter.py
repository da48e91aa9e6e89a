"""Eq. 2 as the arbiter between states that all satisfy the equations.

Contact nodes that break Eq. 2 in a settled state are released, and the sets settle again. The next state
may break it at more, or not settle at all. The answer is the settled state that breaks it at the fewest.
"""

from enum import Enum

RELEASE_STEPS = 8
"""Steps in which the sets must settle again after a release: 1 to 40 do the same in contact starts."""

EARLY = 1e-4
"""Residual below which Eq. 2 is checked where the fluid is solved apart: a twelfth less work than with
1e-5; with 3e-4 one of 33 contact starts ends with other contact."""

EARLY_ROUNDS = 3
"""Most releases before the residual is small: an edge that opens node by node would never end. Any value
from 1 to 10 does the same; none at all costs mixed lubrication 40 %."""


class Ruling(Enum):
    """What follows from a verdict and Eq. 2."""

    GO_ON = "take a step"
    TRY_RELEASE = "keep this answer, let go what breaks Eq. 2 in it and settle again"
    RELEASE_EARLY = "let go what breaks Eq. 2, and go on"
    ACCEPT = "the present state is the answer"
    KEEP = "the answer kept before is better"
    GIVE_UP = "there is no answer"

    @property
    def ends(self):
        """True where the iteration is over."""
        return self in (Ruling.ACCEPT, Ruling.KEEP, Ruling.GIVE_UP)


def rule(position, verdict, partition, fluid_apart):
    """The `Ruling` on a position (collective); `fluid_apart` where fluid is solved apart from the gap."""
    state, trial = position.state, position.trial
    if verdict.converged:
        if not partition.asks_eq_2:
            return Ruling.ACCEPT
        if trial and partition.count_violations(state) >= trial.violations:
            return Ruling.KEEP
        return Ruling.TRY_RELEASE if partition.count_releasable(state) else Ruling.ACCEPT
    if verdict.ends:
        return Ruling.KEEP if trial else Ruling.GIVE_UP
    if fluid_apart and _is_time_for_an_early_release(position) and partition.count_releasable(state):
        return Ruling.RELEASE_EARLY
    if trial and trial.released <= trial.entered:
        return Ruling.KEEP  # as many nodes closed as Eq. 2 let go: this grid cannot satisfy it
    return Ruling.GO_ON


def _is_time_for_an_early_release(position):
    """Whether Eq. 2 may be checked before the residual is small: with the fluid solved apart it is known
    early which nodes break it. That saves 3 to 5 steps."""
    return position.cycles[-1].residual <= EARLY and position.early_rounds < EARLY_ROUNDS
