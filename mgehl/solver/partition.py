"""Which nodes are film, cavity and contact: re-partitioned between Newton steps.

cavitated: enters when P < 0, leaves when it would hold more than its gap does. contact: enters when H <=
H_th, leaves when P < 0; one that leaves its faces open leaves when p > P, too. Bare contact lets nothing
out, and what is carried in goes on: all contact behind leaves with it, each node once. Where that was wrong
it closes again. Node by node a film took half of all steps to pass a contact.

All whose sign is wrong change at once; where that goes in a circle, neighbours in turn: a node that is torn
or fills takes away what asked the next one to [block principal pivoting, Judice and Pires 1994]. Those that
wait keep what the step gave them, a negative pressure or more than the gap holds: what is cut lifts the
bodies, and throws thin films beside it. What has just been torn stays a cavity for a step.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import maximum_filter

from mgehl.discretization.axes import own
from mgehl.discretization.mesh import HALO
from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED, NAMES, enclosed, is_fluid
from mgehl.solver.cavitation import overflows
from mgehl.solver.record import Kept

RESTLESS = 12
"""Turns between film and contact after which a node is not expected to settle; 4 to 40 do the same."""

ROUND = 2
"""Turns that a node takes to close and be torn open again."""


@dataclass
class Changes(Kept):
    """Nodes that changed status, over all ranks."""

    cavitated: int = 0
    filled: int = 0
    entered: int = 0
    released: int = 0

    @property
    def total(self):
        return self.cavitated + self.filled + self.entered + self.released

    def compare(self, grid, before, after):
        """Add the nodes whose status has become another one (collective)."""
        other = before != after
        self.cavitated += grid.count(other & (after == CAVITATED))
        self.filled += grid.count(other & (before == CAVITATED) & (after == LUBRICATED))
        self.entered += grid.count(other & (after == CONTACT))
        self.released += grid.count(other & (before == CONTACT))


@dataclass(frozen=True)
class Contradiction(Kept):
    """A node that as film closes, as contact is torn open; nodes count from 1. `gap` is the H at which it
    last became contact, `pressure` P at its last release, `neighbours` are west, east, before, after."""

    i: int
    j: int
    gap: float
    pressure: float
    neighbours: tuple

    @classmethod
    def from_record(cls, record):
        neighbours = tuple(record.values["neighbours"])  # JSON knows lists only
        return cls(**record.values | {"neighbours": neighbours})


@dataclass
class Past(Kept):
    """What the nodes went through, all (lines, nx): it decides what they may do next."""

    just_torn: np.ndarray
    just_released: np.ndarray
    was_released: np.ndarray
    passed: np.ndarray
    """Nodes that opened with contact before them."""
    turns: np.ndarray
    """How often the node went from film to contact and back."""
    closing_gap: np.ndarray
    torn_pressure: np.ndarray

    @classmethod
    def none(cls, shape):
        """Of nodes that went through nothing yet."""
        return cls(
            just_torn=np.zeros(shape, dtype=bool),
            just_released=np.zeros(shape, dtype=bool),
            was_released=np.zeros(shape, dtype=bool),
            passed=np.zeros(shape, dtype=bool),
            turns=np.zeros(shape, dtype=np.int8),
            closing_gap=np.zeros(shape),
            torn_pressure=np.zeros(shape),
        )


class Partition:
    """Moves nodes of a state between the sets; `past`, which may be replaced, is what they went through.
    With `in_turn` neighbours whose signs are wrong change in turn, and not at once. Contact opens with all
    contact behind it where it `passes_on` what is carried in."""

    passes_on = False

    def __init__(self, problem):
        self._problem, self._grid = problem, problem.grid
        self._contact_law, self._tears_at = problem.scheme.contact_law, problem.contact.tears_at
        self.forget()

    def forget(self):
        """Nodes are as before the first step."""
        self.past = Past.none(self._grid.shape)

    def tension(self, P, status, in_turn=False):
        """Where negative pressures tear fluid now, and where contact: arrays (lines, nx) (collective)."""
        negative = P < self._tears_at
        torn = negative & (status == LUBRICATED) & self._problem.scheme.cavitation
        return self._that_change(torn, self._tears_at - P, in_turn), negative & (status == CONTACT)

    def follow_gap(self, state, changes, in_turn):
        """After a step moved the gap: gaps close, contact that its fluid lifts opens, cavities fill."""
        self.enter_contact(state, changes)
        self.open_contact(state, changes, in_turn)
        self.fill(state, changes, in_turn)
        self.fit(state, in_turn)

    def cut_tension(self, state, changes, in_turn=False):
        """Set pressures below that of torn film to it in place: fluid cavitates, contact is released, but
        not where fluid presses under open faces (`open_contact`): that would open empty."""
        P, status = state.P, state.status
        opened, tensile = self.tension(P, status, in_turn)
        apart = tensile & (self._contact_law.closes_faces | (state.p <= self._tears_at))
        self.past.torn_pressure[apart] = P[apart] - self._tears_at
        self.past.turns += apart & self._contact_law.closes_faces
        P[opened | tensile] = self._tears_at
        # Bodies that are torn apart leave an empty gap: a cavity, until fluid flows in.
        status[opened | apart] = CAVITATED
        state.filling[opened], state.filling[apart] = 1.0, 0.0
        self.past.just_torn, self.past.just_released = opened, apart
        self.past.was_released |= apart
        changes.cavitated += self._grid.count(opened)
        changes.released += self._grid.count(apart)

    def enter_contact(self, state, changes):
        """Nodes whose gap is closed, and fluid shut in along the motion, become contact. One pass is
        enough: shut-in fluid shuts in no other. Contact with open faces (`BoundaryFilm`) shuts in nothing,
        and may close and open any number of times."""
        may_close = is_fluid(state.status) & ~self.past.just_released
        closed = may_close & self._contact_law.closed(state.H, self.past.was_released)
        closed |= self._still_pressed(state)
        state.status[closed] = CONTACT
        state.p[closed] = state.P[closed]  # of a film both are one; p is still that before the step
        if self._contact_law.closes_faces:
            self.past.closing_gap[closed] = state.H[closed]
            self.past.turns += closed
            shut_in = enclosed(self._grid.halo_status(state.status), self._problem.axes)
            state.status[shut_in] = CONTACT
            closed |= shut_in
        changes.entered += self._grid.count(closed)

    def _still_pressed(self, state):
        """Nodes that have just been torn open though bodies overlap there by more than the tension was. A
        step not taken whole leaves a first guess' overlap: a film of less than nothing."""
        torn = self.past.just_released & is_fluid(state.status) & (self.past.torn_pressure < 0.0)
        if self._contact_law.closes_faces:
            return np.zeros(torn.shape, dtype=bool)
        return torn & (self.past.torn_pressure > self._lifted(state))

    def _lifted(self, state):
        """Pressures by which nodes would lift themselves off the layers as far as they are, (lines, nx)."""
        return (state.H - self._contact_law.contact_gap) / self._problem.K00

    def fit(self, state, in_turn=False):
        """Contents from nothing to what the gap holds, and p as P where there are no solids; in place."""
        most = np.where((state.status == CAVITATED) & in_turn, np.inf, 1.0)
        state.filling = np.clip(state.filling, 0.0, most)
        contact = (state.status == CONTACT) & (not self._contact_law.closes_faces)
        state.p = np.where(contact, np.maximum(state.p, self._tears_at), state.P)

    def fill(self, state, changes, in_turn=False):
        """Cavities whose content is more than the gap holds become film; return how many. In turn, what has
        just been torn does not: a node that is filled before and torn by every step would never settle."""
        filled = overflows(state) & self._contact_law.takes_fluid(state.H)
        if in_turn:
            filled &= ~self.past.just_torn
        filled = self._that_change(filled, state.filling, in_turn)
        state.status[filled] = LUBRICATED
        count = self._grid.count(filled)
        changes.filled += count
        return count

    def open_contact(self, state, changes, in_turn=False):
        """Contact that leaves its faces open becomes film where the fluid would press harder than it."""
        if self._contact_law.closes_faces:
            return
        excess = state.p - state.P - np.maximum(-self._lifted(state), 0.0)
        opened = self._that_change((state.status == CONTACT) & (excess > 0.0), excess, in_turn)
        if self.passes_on:
            takes = (state.status == CONTACT) & ~self.past.passed
            behind = self._problem.passed_on(opened & takes, takes) & ~opened
            self.past.passed |= behind
            opened |= behind
        state.status[opened] = LUBRICATED
        self.past.just_released |= opened
        changes.released += self._grid.count(opened)

    def _that_change(self, asked, excess, in_turn):
        """Of the nodes that are `asked` to change those that do so now, all (lines, nx) (collective). All
        of them, or each whose `excess` no neighbour that is asked surpasses."""
        if not in_turn:
            return asked
        largest = maximum_filter(self._grid.halo(np.where(asked, excess, 0.0)), size=3)
        return asked & (excess >= own(largest))

    @property
    def restless(self):
        """True when a node has turned between film and contact so often that it will not settle."""
        return self._grid.max(self.past.turns, initial=0) >= RESTLESS

    def contradictions(self, status):
        """The restless nodes that were torn open, and those a round behind them; all ranks' in order."""
        around = self._grid.halo_status(status)
        torn = self.past.torn_pressure < 0.0
        local = []
        for j, i in np.argwhere((self.past.turns >= RESTLESS - ROUND) & torn):
            g = j + HALO
            beside = (around[g, i - 1], around[g, i + 1], around[g - 1, i], around[g + 1, i])
            gap, pressure = float(self.past.closing_gap[j, i]), float(self.past.torn_pressure[j, i])
            names = tuple((*NAMES, "wall")[each] for each in beside)
            local.append(Contradiction(int(i) + 1, int(j) + self._grid.first + 1, gap, pressure, names))
        return [each for part in self._grid.comm.allgather(local) for each in part]
