"""How an iteration stands and how it ends."""

from dataclasses import dataclass, field

from mgehl.solver.partition import Changes, Past
from mgehl.solver.problem import State


@dataclass
class Line:
    """One line of the history: the state before a step, in units of P and H."""

    step: int
    residual: float
    """The true one, of film, cavity and contact."""
    load_error: float
    central: float
    minimum: float
    contact_nodes: int
    cavitated_nodes: int


@dataclass
class Cycle(Line):
    """The state before a Newton step and what led to it."""

    changes: Changes
    linear_iterations: int = 0
    step_length: float = 1.0


@dataclass
class Outcome:
    """How Newton's method ended."""

    state: State
    converged: bool
    reason: str
    cycles: list = field(default_factory=list)
    contradictions: list = field(default_factory=list)
    """Nodes that kept turning between film and contact."""


@dataclass(frozen=True)
class Answer:
    """A state that settled, kept while Eq. 2 is tried on it."""

    state: State
    reason: str
    violations: int


@dataclass
class Position:
    """Where the iteration stands before a step: all that the way from here depends on."""

    outcome: Outcome
    """So far: its state is the present one."""
    past: Past
    limit: int
    """Step at which to give up."""
    changes: Changes = field(default_factory=Changes)
    """Of the sets since the last cycle."""
    linear_iterations: int = 0
    step_length: float = 0.0
    answer: Answer | None = None
    released: int = 0
    """Nodes that Eq. 2 released when it was last tried, and nodes that closed since."""
    entered: int = 0
    early_rounds: int = 0
    """Releases on Eq. 2 before the last digits."""
    stalls: int = 0
    """Linear systems that were given up."""
