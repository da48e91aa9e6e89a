"""The way back from a step that led astray.

Peaks shut fluid into valleys. Past some pressure, more of it makes the fluid so stiff that less of it
flows out: then the valley's pressure runs away, as that of a node beyond its fold (`squeeze`). A valley
has no rate of its own that would keep it stable. Near its fold Newton's step is as good as random, and
the residual is several times what it was before. Then the state before is taken up again, and the next
time steps are shorter. Every step makes them a little longer again.
"""

from dataclasses import dataclass

from mgehl.solver.partition import Past
from mgehl.solver.problem import State
from mgehl.solver.record import Kept

ASTRAY = 3.0
"""Residual after a step, over that before it, from which on the step led astray. With 3, 5 and 10 a ball of
265 nm rms at 0.04 mm/s settles in 2400 to 2800 convolutions; without going back it does not."""

JUDGED = 1e-2
"""Residual below which a step may lead astray: before, contact spreads, and the residual rises with it."""

HARD = 50
"""Iterations of GMRES that tell a fold: there the Jacobian is nearly singular. Where steps are of full
length, only such a one leads astray: elsewhere the residual rises where sets change, and falls again.
From 35 to 80 the work varies by a tenth; if every step may lead astray, balls that settle anyway take up to
half more."""

SHORTER, LONGER, SHORTEST = 8.0, 0.7, 1e5
"""By how much time steps become shorter where one led astray, what every step leaves of that, and by how
much they are shorter at the most. With 20 and 0.6 balls of 188 and 376 nm rms at 0.04 and 0.14 mm/s do not
settle."""


@dataclass
class Foothold(Kept):
    """A state before a step in time: all that is needed to take it up again."""

    state: State
    past: Past
    residual: float

    @classmethod
    def of(cls, position):
        """The present state, kept."""
        return cls(position.state.copy(), position.past.copy(), position.cycles[-1].residual)

    @classmethod
    def from_record(cls, record):
        state, past = State.from_record(record.part("state")), Past.from_record(record.part("past"))
        return cls(state, past, record.values["residual"])


def led_astray(position):
    """Whether the foothold is to be taken up again: after a linear system that was given up, too."""
    foothold, now = position.foothold, position.cycles[-1]
    if foothold is None or foothold.residual >= JUDGED or position.shorter >= SHORTEST:
        return False
    near_a_fold = position.shorter > 1.0 or now.linear_iterations >= HARD
    return position.stalls > 0 or (near_a_fold and not now.residual <= ASTRAY * foothold.residual)
