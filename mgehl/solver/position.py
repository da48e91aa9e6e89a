"""Where an iteration stands before a step: all that the way from here depends on."""

from dataclasses import dataclass, field

from mgehl.solver.outcome import Cycle
from mgehl.solver.partition import Changes, Past
from mgehl.solver.problem import State
from mgehl.solver.record import Kept, Record


@dataclass(frozen=True)
class Step(Kept):
    """What the last Newton step took."""

    linear_iterations: int = 0
    length: float = 0.0
    """Part of Newton's step that was taken."""


@dataclass
class Position(Kept):
    """The present state and what is remembered of the way; written by `Newton` alone."""

    PARTS = {"state": State, "past": Past, "changes": Changes, "step": Step, "memory": Record}
    ROWS = {"cycles": ("history", Cycle)}

    state: State
    past: Past
    cycles: list = field(default_factory=list)
    """The history, a `Cycle` for each state before a step."""
    changes: Changes = field(default_factory=Changes)
    """Of the sets since the last cycle."""
    step: Step = Step()
    stalls: int = 0
    """Linear systems that were given up."""
    memory: Kept | Record | None = None
    """Of the linear systems before: what the linear solver has, or what was kept of it."""

    def row(self, problem, F, load):
        """Of the history, for the present state with its residual `F` and load error (collective)."""
        state, step = self.state, self.step
        measured = problem.rms(F), load, *problem.films(state), *problem.counts(state.status)
        return Cycle(len(self.cycles), *measured, self.changes, step.linear_iterations, step.length)
