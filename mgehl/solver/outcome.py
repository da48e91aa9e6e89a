"""What a solve leaves: its history row by row, and how it ended."""

from dataclasses import dataclass, field

from mgehl.solver.partition import Changes, Contradiction
from mgehl.solver.problem import State
from mgehl.solver.record import Kept


@dataclass
class Line(Kept):
    """One row of the history: the state before a step, in units of P and H."""

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

    PARTS = {"changes": Changes}

    changes: Changes
    linear_iterations: int = 0
    step_length: float = 1.0


@dataclass
class Outcome(Kept):
    """How a solve ended."""

    PARTS = {"state": State}
    ROWS = {"cycles": ("history", Cycle), "contradictions": ("contradictions", Contradiction)}

    state: State
    converged: bool
    reason: str
    cycles: list = field(default_factory=list)
    contradictions: list = field(default_factory=list)
    """Nodes that kept turning between film and contact."""
    begins: str | None = None
    """The way that led to it, as `recipe.Recipe.begins`, where that is another than its recipe's."""

    @classmethod
    def from_record(cls, record, line=Cycle):
        """As `Kept.from_record`; `line` is the class of a row of its history."""
        found = super().from_record(record.without("history"))
        found.cycles = [line.from_record(row) for row in record.part("history").rows()]
        return found
