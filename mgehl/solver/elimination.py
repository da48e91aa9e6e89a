"""A few nodes that hold up all others, solved by themselves between two Newton steps.

Where thin films end at peaks one node's flow may change a thousandfold in a step, and the end of a film
moves on by a node a step. Newton's method for all nodes then takes a step of all for a few of them. These,
in windows a few nodes wide, are solved first, all others being held  [nonlinear elimination: Lanzkron, Rose
and Wilkes 1996; Hwang, Lin and Cai 2010]. It takes one convolution, for the gap elsewhere.
"""

from dataclasses import replace
from functools import partial

import numpy as np
from scipy.ndimage import find_objects, label, maximum_filter

from mgehl.discretization.influence import influence_coefficients
from mgehl.solver.partition import Changes, Partition
from mgehl.solver.problem import State
from mgehl.solver.window import RING, Window

FEW, SHARE = 100, 0.98
"""So many nodes at the most must make up so much of the sum of squares of the residual."""

AROUND = 6
"""Nodes on each side of such a node that are solved with it."""

LARGEST = 1500
"""Most nodes of a window, those that stand still included: its linear systems are dense."""

WAYS = 0.0, 3.0, 30.0
"""Rates of implicit time steps (`squeeze`) that are tried one after the other: Newton's own steps may go
round between few nodes, too."""

STEPS, PATIENCE = 20, 8
"""Newton steps of a way, and those after which the residual must have fallen to half."""

SOLVED, ENOUGH, GAINED = 1e-2, 0.1, 0.5
"""Parts of its residual at which a window counts as solved, at which no other way is tried, and of which
more is no gain: the nodes then stay as they were."""

NOT_BELOW = 1e-7
"""Rms residual below which Newton's steps converge by themselves."""

WHOLE = "P", "H", "p", "filling", "status"
"""What a `State` has of every node."""


class Elimination:
    """Solves a few nodes of a `ContactProblem` by themselves; `settings` are `NewtonSettings`."""

    def __init__(self, problem, settings):
        self._problem, self._settings = problem, settings
        self._K = np.zeros((0, problem.grid.mesh.nx))

    def of(self, state, changes, in_turn):
        """Bring the few nodes to rest that make up most of a state's residual, in place; sets change as in
        a `Partition` (collective)."""
        problem, grid = self._problem, self._problem.grid
        left = self._left(state)
        before = problem.rms(left)
        if before <= NOT_BELOW or not (windows := grid.on_first(windows_of, left)):
            return
        arrays = [getattr(state, name) for name in WHOLE]
        solve = partial(self._solve, windows, state.H0, in_turn)
        whole = grid.on_first(solve, problem.feeding(state.status), *arrays)
        if whole is None:
            return
        found = {name: array[grid.first : grid.last] for name, array in whole.items()}
        found["H"] = problem.gap(found["P"], state.H0)
        solved = State(H0=state.H0, **found)
        Partition(problem).follow_gap(solved, Changes(), in_turn)
        if problem.rms(self._left(solved)) < GAINED * before:
            changes.compare(grid, state.status, solved.status)
            for name in WHOLE:
                getattr(state, name)[:] = getattr(solved, name)

    def _left(self, state):
        """The size of a state's residual, (lines, nx), with the flow under contact."""
        problem, state = self._problem, state.copy()
        evaluation, status = problem.march_contents(state, problem.evaluate(state)), state.status
        return problem.with_flow_under_contact(problem.residual(evaluation, status), evaluation, status)

    def _solve(self, windows, H0, in_turn, feeds, *arrays):
        """What `WHOLE` names, (ny, nx) each, with the nodes of `windows` solved, one after the other; None
        where that gains nothing."""
        whole, gained = dict(zip(WHOLE, arrays, strict=True)), False
        for box, free in windows:
            state = State(H0=H0, **{name: array[box].copy() for name, array in whole.items()})
            window = Window(self._problem, self._influence(len(free)), free, feeds[box])
            if found := self._solved(window, state, in_turn):
                gained = True
                for name, array in whole.items():
                    array[box] = getattr(found, name)
        return whole if gained else None

    def _solved(self, window, state, in_turn):
        """The `State` that one of the `WAYS` leads to; None where none gains anything."""
        first = best = window.measured(state)
        for rate in WAYS[int(in_turn) :]:
            found = self._by_steps(window, first, replace(self._settings, squeeze=rate), in_turn)
            best = min(best, found, key=lambda each: each.size)
            if best.size <= ENOUGH * first.size:
                break
        return best.state if best.size < GAINED * first.size else None

    def _by_steps(self, window, first, settings, in_turn):
        """The best `Measured` state of the steps from the `first`."""
        best = at = first
        window.forget()
        for step in range(STEPS):
            new, changed = window.step(at, settings, in_turn)
            if new is None or (step >= PATIENCE and best.size > GAINED * first.size):
                break
            at = window.measured(new)
            best = min(best, at, key=lambda each: each.size)
            if best.size <= SOLVED * first.size and changed == 0:
                break
        return best

    def _influence(self, lines):
        """The influence of a node on others, by lines and nodes between them, of so many lines at least."""
        if lines > len(self._K):
            problem = self._problem
            self._K = influence_coefficients(problem.grid.mesh, problem.contact.kernel, 0, lines)
        return self._K


def windows_of(left):
    """(Box, its free nodes) of each window around the few nodes that make up `SHARE` of the sum of squares
    of what is `left`, (ny, nx); none where they are not few."""
    squares = left**2
    falling = np.sort(squares, axis=None)[::-1]
    count = np.searchsorted(np.cumsum(falling), SHARE * falling.sum()) + 1
    if count > FEW:
        return []
    regions, _ = label(maximum_filter(squares >= falling[count - 1], size=2 * AROUND + 1))
    boxes = [
        tuple(slice(max(each.start - RING, 0), each.stop + RING) for each in region)
        for region in find_objects(regions)
    ]
    windows = [(box, regions[box] == number) for number, box in enumerate(boxes, 1)]
    return [(box, free) for box, free in windows if free.size <= LARGEST]
