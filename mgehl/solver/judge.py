"""Whether an iteration has come to its end, and why: looks at a position, changes nothing."""

from dataclasses import dataclass
from enum import Enum
from itertools import pairwise
from math import inf

from petsc4py import PETSc

from mgehl.solver.problem import DIVERGED

STALLS = 3
"""Linear systems that GMRES may leave unsolved before a solve is given up: no state is near."""

UNSOLVED = 0.5
"""A linear system counts as unsolved where GMRES leaves more than this part of its residual."""

STUCK = 0.9
"""A step that leaves more than this part of the residual gained nothing. After two the cavities are not
relaxed before the next step: relaxation and step might undo each other. Where they are relaxed all the
same, a smooth film by the arithmetic mean that closes continuously takes twice the work."""

ROUNDED = 3
"""Steps that did not lower a small residual, after which rounding is left."""

MOST_ROUNDING = 1000.0
"""Times the tolerance that rounding may leave at the most."""

IDLE_CIRCLE = 8.0
"""Whole steps that did not lower the residual from which on neighbours change sets in turn, where contact
closes continuously: without it hardly half of thin-film balls without layers are found. A shortened step
counts for its length: it is on its way, and its residual says little of the sets."""


BACK_AND_FORTH = 4
"""Steps in vain that changed no set, after which half of the next one is taken: by what it stiffens with,
the fluid's pressure in a layer may go from far below its answer to far above, and back."""


class SetsChange(Enum):
    """How the sets change around a step."""

    AT_REST = "all nodes whose sign is wrong, and cavities come to rest at the present gap before the step"
    AT_ONCE = "all nodes whose sign is wrong"
    IN_TURN = "of neighbours the one whose sign is most wrong, after a linear system that is solved finely"


IN_TURN_TOLERANCE = 0.01
"""Relative tolerance of GMRES where neighbours change in turn: a few valley nodes make up most of the
residual, and what 0.1 of it leaves to others turns their signs. Finer tolerances find no more."""


@dataclass(frozen=True)
class Verdict:
    """Of a position: go on, settled, or given up."""

    ends: bool
    converged: bool = False
    reason: str = ""
    contradictions: tuple = ()
    """Nodes that can be neither film nor contact."""


GO_ON = Verdict(ends=False)


def judge(position, partition, limits, rounding=lambda: 0.0):
    """The `Verdict` on a position whose last cycle has just been measured (collective). `limits` are
    `NewtonSettings`, patience included. `rounding()` is the residual that rounding may leave."""
    cycle = position.cycles[-1]
    idle = len(since_lowered(position))
    limit = limits.tolerance
    if idle >= ROUNDED and limit < cycle.residual <= MOST_ROUNDING * limit:
        limit = allowed(limit, cycle.minimum, rounding())
    small = cycle.residual <= limit and abs(cycle.load_error) <= limits.tolerance
    if small and cycle.changes.total == 0:
        return Verdict(True, True, "residual, load and sets settled")
    if small and cycle.residual < limits.certain:
        return Verdict(True, True, "residual and load settled, below what tells the sets apart")
    if not cycle.residual < DIVERGED:
        return Verdict(True, reason=f"diverged: residual {cycle.residual:.1e} after {cycle.step} steps")
    if partition.restless:
        return _never_settling(partition.contradictions(position.state.status), cycle.step)
    if position.stalls == STALLS:
        return Verdict(True, reason=f"{STALLS} linear systems in {cycle.step} steps could not be solved")
    if not small and idle >= limits.idle_steps:
        return Verdict(True, reason=_idle(cycle, limits.idle_steps))
    if limits.spreading_steps and steps_of_spreading(position) >= limits.spreading_steps:
        return Verdict(
            True, reason=f"contact spreads, to {cycle.contact_nodes} nodes in {cycle.step} steps"
        )
    if cycle.step >= limits.max_steps:
        settled = "sets still change after" if small else f"residual {cycle.residual:.1e} after"
        return Verdict(True, reason=f"{settled} {cycle.step} steps")
    return GO_ON


def allowed(tolerance, smallest, rounding):
    """The largest residual of an answer whose smallest gap this is, in units of H: of what flows through a
    film thicker than that unit the same part, or what `rounding` may leave. That was 1.1e-8 of 68 units, of
    a light roller on 4097 nodes, and 1.2e-10 of deep waves on 1025."""
    return max(tolerance * max(1.0, smallest), min(rounding, MOST_ROUNDING * tolerance))


def how_sets_change(position, by_film):
    """The `SetsChange` around the next step from a position, by what the last steps gained. `by_film` says
    whether contact closes continuously."""
    if by_film and way_in_vain(position) >= IDLE_CIRCLE:
        return SetsChange.IN_TURN
    last = [cycle.residual for cycle in position.cycles[-3:]]
    gained_nothing = len(last) == 3 and min(last[1:]) > STUCK * last[0]
    if gained_nothing:
        return SetsChange.AT_ONCE
    return SetsChange.AT_REST


def way_in_vain(position):
    """Steps since the residual was last clearly lower than ever before, a shortened one by its length."""
    return sum(cycle.step_length for cycle in since_lowered(position))


def to_and_fro(position):
    """Whether the last steps lowered no residual although they changed no set: whole steps then lead from
    one side of an answer to the other."""
    last = since_lowered(position)[-BACK_AND_FORTH:]
    return len(last) == BACK_AND_FORTH and not any(cycle.changes.total for cycle in last)


def since_lowered(position):
    """The `Cycle`s since the residual was last clearly lower than ever before."""
    least, first = inf, 0
    for number, cycle in enumerate(position.cycles, 1):
        if cycle.residual < STUCK * least:
            least, first = cycle.residual, number
    return position.cycles[first:]


def steps_of_spreading(position):
    """Steps after which contact had more nodes than before."""
    nodes = [cycle.contact_nodes for cycle in position.cycles]
    return sum(after > before for before, after in pairwise(nodes))


def judge_work(verdict, work, most):
    """The same `Verdict`, unless it goes on and the run has made too many convolutions."""
    if verdict.ends or work < most:
        return verdict
    return Verdict(True, reason=f"{work:.0f} convolutions led to no answer")


def judge_system(reason, position):
    """The `Verdict` on a linear system that was solved, or not, with this KSP's `reason`."""
    if reason == PETSc.KSP.ConvergedReason.DIVERGED_NANORINF:
        step = position.cycles[-1].step
        return Verdict(True, reason=f"singular: no linear solution after {step} steps")
    return GO_ON


def _idle(cycle, steps):
    return f"residual {cycle.residual:.1e} after {cycle.step} steps: the last {steps} did not lower it"


def _never_settling(nodes, step):
    """The verdict on sets that cycle."""
    reason = (
        f"{len(nodes)} nodes can be neither film, whose gap closes, nor contact, which is torn open: "
        f"the sets cycle after {step} steps"
    )
    return Verdict(True, reason=reason, contradictions=tuple(nodes))
