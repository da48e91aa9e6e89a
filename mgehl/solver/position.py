"""Where an iteration stands before a step: all that the way from here depends on."""

from dataclasses import dataclass, field

from mgehl.solver.partition import Changes, Past
from mgehl.solver.problem import State


@dataclass(frozen=True)
class Step:
    """What the last Newton step took."""

    linear_iterations: int = 0
    length: float = 0.0
    """Part of Newton's step that was gone."""


@dataclass
class Trial:
    """Eq. 2 tried on a state that settled: what was let go must settle again."""

    answer: State
    """The state that settled, kept."""
    reason: str
    violations: int
    """Nodes of the answer that break Eq. 2."""
    released: int
    limit: int
    """Step at which the trial has failed."""
    entered: int = 0
    """Nodes that came into contact since."""


@dataclass
class Position:
    """The present state and what is remembered of the way; written by `Newton` alone."""

    state: State
    past: Past
    cycles: list = field(default_factory=list)
    """The history, a `Cycle` for each state before a step."""
    changes: Changes = field(default_factory=Changes)
    """Of the sets since the last cycle."""
    step: Step = Step()
    trial: Trial | None = None
    early_rounds: int = 0
    """Releases on Eq. 2 before the last digits."""
    stalls: int = 0
    """Linear systems that were given up."""
