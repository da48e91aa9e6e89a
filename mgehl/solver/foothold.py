"""The way back from a step that led astray.

Peaks shut fluid into valleys. Past some pressure, more of it makes the fluid so stiff that less of it
flows out: then the valley's pressure runs away, as that of a node beyond its fold (`squeeze`). A valley
has no rate of its own that would keep it stable. Near its fold Newton's step is as good as random, and
the residual is several times what it was before. Then the state before is taken up again, and the next
time steps are shorter. Every step makes them a little longer again.

Where steps gain nothing for long, a few nodes may turn from film to cavity and back, one step after the
other. Shorter time steps leave such a circle, too.
"""

from dataclasses import dataclass

from mgehl.solver.judge import steps_since_lowered
from mgehl.solver.partition import Past
from mgehl.solver.problem import State
from mgehl.solver.record import Kept

ASTRAY = 3.0
"""Residual after a step, over that before it, from which on the step led astray. With 3, 5 and 10 a ball of
265 nm rms at 0.04 mm/s settles in 2400 to 2800 convolutions; without going back it does not."""

JUDGED = 1e-2
"""Residual below which a step may lead astray: before, contact spreads, and the residual rises with
it. (Where nearby nodes are solved at once, a step may do so from the first.)"""

HARD = 50
"""Iterations of GMRES that tell a fold: there the Jacobian is nearly singular. Where steps are of full
length, only such a one leads astray: elsewhere the residual rises where sets change, and falls again.
From 35 to 80 the work varies by a tenth; if every step may lead astray, balls that settle anyway take up to
half more. Where nearby nodes are solved at once, GMRES takes few iterations near a fold, too: there every
step may lead astray."""

SHORTER, LONGER, SHORTEST, LONGEST = 8.0, 0.7, 1e5, 1e-2
"""By how much time steps become shorter where one led astray, what every step leaves of that, and by how
much they are shorter at the most and at the least. With 20 and 0.6 balls of 188 and 376 nm rms at 0.04 and
0.14 mm/s do not settle. Steps longer than their rule has them are taken only where every step is judged: a
valley fills slowly, with a residual that stays what it is. Where the longest lead nowhere either, the sets
may go round in a circle: then short steps begin again, which leave it (a ball of 136 nm rms at 0.029 mm/s
does not settle without)."""

IN_VAIN = 15
"""Steps that gained nothing, after which time steps become shorter, by `SHORTER` (a ball of 104 nm rms at
0.02 mm/s: eight nodes turned for 60 steps; with 8, 64 or 4096 times shorter ones it settles). Where every
step is judged, time steps change by themselves."""


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


def led_astray(position, every_step=False):
    """Whether the foothold is to be taken up again: after a linear system that was given up, too.

    Where not `every_step` may lead astray, only one near a fold does, from a small residual.
    """
    foothold, now = position.foothold, position.cycles[-1]
    if foothold is None or position.shorter >= SHORTEST:
        return False
    if not every_step and foothold.residual >= JUDGED:
        return False
    near_a_fold = every_step or position.shorter > 1.0 or now.linear_iterations >= HARD
    return position.stalls > 0 or (near_a_fold and not now.residual <= ASTRAY * foothold.residual)


def lengthened(position, every_step=False):
    """By how much the next time steps are shorter than their rule has them, one step later.

    Where the last step made the residual larger, the next one is the less longer for it.
    """
    if not every_step or position.foothold is None:
        return max(SHORTER if _goes_round(position) else 1.0, LONGER * position.shorter)
    before, now = position.foothold.residual, position.cycles[-1].residual
    shorter = LONGER * max(1.0, now / before) * position.shorter
    if now >= JUDGED:
        return max(1.0, shorter)
    return shorter if shorter > LONGEST else SHORTER


def _goes_round(position):
    """Whether the sets may go round in a circle: again `IN_VAIN` steps gained nothing."""
    in_vain = steps_since_lowered(position)
    return in_vain > 0 and in_vain % IN_VAIN == 0
