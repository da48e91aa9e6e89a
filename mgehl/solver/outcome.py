"""What a solve leaves: its history line by line, and how it ended."""

from dataclasses import dataclass, field

from mgehl.solver.partition import Changes
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
    """How a solve ended."""

    state: State
    converged: bool
    reason: str
    cycles: list = field(default_factory=list)
    contradictions: list = field(default_factory=list)
    """Nodes that kept turning between film and contact."""
