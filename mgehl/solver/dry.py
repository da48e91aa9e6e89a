"""The dry contact: bodies pressed together without a fluid, P >= 0, gap >= 0, one of them zero.

Primal-dual active set [Hintermueller, Ito, Kunisch 2003]: conjugate gradients look for the pressure of the
pressed nodes under which their gap is the same, which the approach of the bodies takes away; nodes that
pull leave, nodes that overlap enter. `Deflection.inverted` preconditions, so steps do not grow with the
grid. The gap follows by what steps have convolved. Early sets are solved to one digit, on coarse grids.
"""

from dataclasses import dataclass, field
from functools import partial
from itertools import count

import numpy as np

from mgehl.config_sections import SolverSection
from mgehl.discretization.status import CONTACT, LUBRICATED
from mgehl.solver.journal import NOTHING_KEPT
from mgehl.solver.outcome import Outcome
from mgehl.solver.problem import ContactProblem, State
from mgehl.solver.record import Kept, Record

REDUCTION = 0.1
"""What is left of the error on a set before it is looked at again; 0.05 to 0.3 do as well."""

SHARE = 0.01
"""Largest gap of a pressed node, over the tolerance: with two digits more the edge's nodes count right."""

ROUNDING = 1e-13
"""Overlap, in units of H, below which a node does not enter: it may be rounding."""

TRACE = 1e-200
"""Pressure by which a node belongs to a set: nothing beside any other, but more than 0."""

MOST_ITERATIONS = 200
"""Most iterations of conjugate gradients on one set: rough balls take fewer than 20."""

GUESS, GUESS_GAP = 0.03, 1e-3
"""Errors of a first guess at a node, in units of P and of H: as good as the exact dry contact."""

FIRST_NODES, NESTED_NODES = 65, 257
"""Nodes of the first coarse grid, and of the smallest finest grid for which coarse grids pay."""


@dataclass
class DryStep(Kept):
    """A set of pressed nodes and what was found of it."""

    step: int
    residual: float
    """Root mean square of the gap at pressed nodes, in units of H."""
    load_error: float
    contact_nodes: int
    changed_nodes: int
    """Nodes that pull or overlap: the next set is another by them."""
    linear_iterations: int


@dataclass
class DryStanding(Kept):
    """Where a solve stands before a step: the pressure (lines, nx), and the history."""

    P: np.ndarray
    cycles: list = field(default_factory=list)

    def record(self):
        return Record.of(state=Record.of(P=self.P), history=Record.table(self.cycles))

    @classmethod
    def from_record(cls, record):
        steps = [DryStep.from_record(each) for each in record.part("history").rows()]
        return cls(record.part("state").arrays["P"], steps)


def solve_dry(problem, P, tolerance, max_steps, monitor, journal=NOTHING_KEPT):
    """The `Outcome` of the dry contact of a `ContactProblem`; `P` (lines, nx) is a guess. `monitor` is
    called with each `DryStep`; the `journal` as in `Newton.run`."""
    grid = problem.grid
    outcome = journal.recall(grid, partial(Outcome.from_record, line=DryStep))
    if outcome is None:
        standing = journal.standing(grid, DryStanding.from_record)
        standing = standing or DryStanding(carrying_pressure(problem, P))
        state, reason = _settle(problem, standing, tolerance, max_steps, monitor, journal)
        outcome = Outcome(state, not reason, reason or "the set of pressed nodes settled", standing.cycles)
        journal.finish(grid, outcome)
    return outcome


def guess_on_finest(hierarchy, contact, scheme):
    """A first P (lines, nx) on the finest grid, Hertz' of smooth bodies, else by coarser (collective)."""
    grids, P = hierarchy.grids, None
    if not contact.is_hertzian and grids[-1].mesh.nx >= NESTED_NODES:
        for grid, deflection, finer in zip(grids, hierarchy.deflections, hierarchy.transfers, strict=False):
            if grid.mesh.nx >= FIRST_NODES:
                P = contact.guessed_pressure(grid.X, grid.Y) if P is None else P
                seen = contact.seen_by(grid.mesh, grids[-1].mesh)
                P = finer.bilinear(dry_pressure(ContactProblem(grid, deflection, seen, scheme), P))
    return contact.guessed_pressure(grids[-1].X, grids[-1].Y) if P is None else P


@dataclass(frozen=True)
class OnCoarser:
    """What the next coarser grid says of a dry contact."""

    nodes: int
    settled: bool
    largest: float
    """Largest pressure, in p_h."""
    apart: float
    """Mean size of the pressure's differences from the finer grid, by pressure."""
    H0: float


def on_coarser(hierarchy, problem, P, solve):
    """The `OnCoarser` of the contact of a `problem` on the finest grid, from its pressure P (lines, nx).

    None without such a grid. `solve` finds the `Outcome` of a problem from a guess (collective).
    """
    level = len(hierarchy.grids) - 2
    if level < 0:
        return None
    grid, there = hierarchy.grids[level], hierarchy.transfers[level].inject(P)
    coarser = ContactProblem(grid, hierarchy.deflections[level], problem.contact, problem.scheme)
    presses = grid.sum(there.sum()) > 0.0  # peaks may stand between its nodes
    outcome = solve(coarser, there if presses else problem.contact.guessed_pressure(grid.X, grid.Y))
    found = outcome.state.P
    apart = grid.sum(np.vdot(found, np.abs(found - there))) / grid.sum(found.sum())
    return OnCoarser(grid.mesh.nx, outcome.converged, grid.max(found), float(apart), outcome.state.H0)


def dry_pressure(problem, P, largest_gap=GUESS_GAP):
    """Roughly the pressure (lines, nx) with which the bodies carry their load; `P` is a guess. Bodies are
    up to `largest_gap` apart where they press, and overlap by no more, in units of H."""
    P, limit = carrying_pressure(problem, P), min(GUESS * problem.K00, largest_gap)
    for _ in range(SolverSection.max_steps):
        pressed = PressedNodes(problem, P)
        pressed.balance(limit)
        P = pressed.without_pull()
        apart = max(pressed.largest_gap, pressed.largest_overlap)
        if apart <= limit and pressed.largest_pull <= GUESS:
            break
    return carrying_pressure(problem, pressed.P)


def carrying_pressure(problem, P):
    """A guess made a pressure: none at the boundary, nowhere a pull, and it carries the load."""
    P = np.where(problem.boundary, 0.0, np.maximum(P, 0.0))
    return problem.carrying(P)


def _settle(problem, standing, tolerance, max_steps, monitor, journal):
    """The final `State`, and why it is not settled; nothing where it is."""
    limit = max(SHARE * tolerance, ROUNDING)
    for step in count(len(standing.cycles) + 1):
        journal.step(problem.grid, standing)
        pressed = PressedNodes(problem, standing.P)
        iterations = pressed.balance(limit)
        standing.cycles.append(pressed.told(step, iterations))
        monitor(standing.cycles[-1])
        why_not = _why_not(standing.cycles[-1], pressed.largest_gap, limit)
        if not why_not or step >= max_steps or not np.isfinite(pressed.largest_gap):
            return pressed.state(), why_not
        standing.P = pressed.without_pull()


def _why_not(step, gap, limit):
    """Why a step is not the last one; empty where it is."""
    if step.changed_nodes:
        return f"{step.changed_nodes} nodes still change between contact and gap after {step.step} steps"
    if not gap <= limit:
        return f"the gap in contact is still {gap:.1e} after {step.linear_iterations} iterations"
    return ""


class PressedNodes:
    """`P` and `gap`, (lines, nx), while a set of nodes is in contact (all methods collective). `gap` is
    that before the bodies approach by `approach`, its mean over the set. The sum of P never changes."""

    def __init__(self, problem, P):
        """`P` carries the load; the set is where it presses."""
        self._problem, self._grid = problem, problem.grid
        self.P, self.pressed = P.copy(), P > 0.0
        self._nodes = self._grid.count(self.pressed)
        self._see(problem.gap(P, 0.0))

    def _see(self, gap):
        """Take note of a gap."""
        self.gap = gap
        self.approach = self._grid.sum(gap[self.pressed].sum()) / self._nodes
        self._left = np.where(self.pressed, gap - self.approach, 0.0)
        self.largest_gap = self._grid.max(np.abs(self._left))

    def balance(self, limit):
        """Conjugate gradients until the gap on the set is within `limit`; return how many. They end before
        that where `REDUCTION` of the error is left and the set is not the right one."""
        direction, energy = self._preconditioned()
        first = energy
        for iteration in range(MOST_ITERATIONS):
            if self.largest_gap <= limit or not energy > 0.0:
                return iteration
            if energy <= REDUCTION**2 * first and self.misplaced:
                return iteration
            response = self._problem.deflection(direction)
            length = energy / self._sum(direction, response)
            self.P -= length * direction
            self._see(self.gap - length * response)
            before = energy
            step, energy = self._preconditioned()
            direction = step + (energy / before) * direction
        return MOST_ITERATIONS

    def _preconditioned(self):
        """The pressure that the gap asks for on the set, its sum zero, and its product with the gap."""
        found = self._problem.deflection.inverted(self._left)
        mean = self._grid.sum(found[self.pressed].sum()) / self._nodes
        found = np.where(self.pressed, found - mean, 0.0)
        return found, self._sum(self._left, found)

    def _sum(self, one, other):
        return self._grid.sum(np.vdot(one, other))

    @property
    def misplaced(self):
        """How many nodes pull or overlap."""
        return self._grid.count(self._pulling) + self._grid.count(self._overlapping)

    @property
    def _pulling(self):
        return self.pressed & (self.P <= 0.0)

    @property
    def _overlapping(self):
        apart = ~(self.pressed | self._problem.boundary)
        return apart & (self.gap - self.approach < -ROUNDING)

    @property
    def largest_overlap(self):
        """Of nodes that are not in the set."""
        apart = ~(self.pressed | self._problem.boundary)
        return self._grid.max(self.approach - self.gap[apart], initial=0.0)

    @property
    def largest_pull(self):
        """Of nodes in the set, in p_h."""
        return self._grid.max(-self.P, initial=0.0)

    def without_pull(self):
        """The pressure to go on with: nodes that pull have none, those that overlap a trace. It carries the
        load."""
        return carrying_pressure(self._problem, np.where(self._overlapping, TRACE, self.P))

    def told(self, step, iterations):
        """The `DryStep` of it."""
        rms = np.sqrt(self._sum(self._left, self._left) / self._nodes)
        error = self._problem.load_deficit(self.P)
        return DryStep(step, float(rms), float(error), self._nodes, self.misplaced, iterations)

    def state(self):
        """The `State`, bodies in contact where they press."""
        status = np.where(self._problem.boundary, 0, np.where(self.pressed, CONTACT, LUBRICATED))
        return State(self.P, -self.approach, self.gap - self.approach, status.astype(np.int8))
