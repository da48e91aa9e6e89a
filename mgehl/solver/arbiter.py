"""Eq. 2 as the arbiter: of partitions that all satisfy the gap conditions, it takes its pick.

A state that settled is an answer. What breaks Eq. 2 in it is let go and the sets settle again: contact
pressures jump where a node opens, so the state found then may break Eq. 2 at more nodes, or not settle
at all. The one that settled with the fewest is the answer. Nothing is changed here: the ruling says
what is to be done.
"""

from enum import Enum

RELEASE_STEPS = 8
"""Steps in which a set must settle again after Eq. 2 released some of it: it bounds trials that lead
nowhere. From 1 to 40 the same steps in contact starts on 129 and 257 nodes."""

EARLY = 1e-5
"""Residual from which Eq. 2 is asked where the fluid is solved apart. From 3e-6 to 1e-5 the same steps;
mixed lubrication takes an eighth more convolutions with 1e-6, and as many fewer with 3e-5."""

EARLY_ROUNDS = 3
"""Releases before the last digits: 2049 nodes take two; an edge that opens node by node has no end. From 1
to 10 the same steps on 129 and 257 nodes; with none mixed lubrication takes 86 convolutions instead of
61."""


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
    """Whether Eq. 2 may be asked before the last digits.

    Where all of the ellipse is in contact and the fluid is solved apart, what breaks Eq. 2 is
    known long before them, while a few nodes still turn: a round of release saves 3 to 5 steps.
    """
    return position.cycles[-1].residual <= EARLY and position.early_rounds < EARLY_ROUNDS
